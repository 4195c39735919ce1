#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "course/store/course_key.h"
#include "course/store/receipts.h"
#include "platform/atomic_file.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct VerifyArgs {
    std::string receipt, key, file;
};

/// The key that was named, or the one that lies beside the receipt or here.
std::optional<PublicKey> key_at_hand(const VerifyArgs& args) {
    if (!args.key.empty()) return read_public_key(args.key);
    for (const fs::path& folder : {fs::absolute(args.receipt).parent_path(), fs::current_path()})
        if (fs::exists(folder / kPublicKeyFile)) return read_public_key(folder / kPublicKeyFile);
    return {};
}

int verify(const VerifyArgs& args) {
    const std::string text = read_file(args.receipt);
    const std::optional<PublicKey> known = key_at_hand(args);
    const std::string own = key_in_receipt(text);
    ReceiptCheck receipt_check = verify_receipt(text, known ? known->digits : own);
    if (receipt_check.genuine && !args.file.empty() && !is_receipt_for(text, args.file))
        receipt_check = {false, fmt::format("genuine, but NOT for {}: that file has a different SHA-256", args.file)};
    std::string signer;
    if (receipt_check.genuine)
        signer = known ? fmt::format(", signed by the course \"{}\"", known->course)
                       : fmt::format(
                             ", signed with the key that it contains:\n"
                             "{}\n"
                             "Check that this is your course's key: see its {} or its page.",
                             own, kPublicKeyFile);
    std::cout << terminal_text(fmt::format("{}: {}{}{}\n", args.receipt, receipt_check.reason,
                                           receipt_check.genuine && !args.file.empty() ? ", for exactly this file" : "",
                                           signer));
    return receipt_check.genuine ? kDone : kFailed;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
    auto args = std::make_shared<VerifyArgs>();
    CLI::App* command = app.add_subcommand("verify", "Verify the receipt of a course, without access to the course");
    command->add_option("RECEIPT", args->receipt, "Receipt of a submission")->required()->check(CLI::ExistingFile);
    command->add_option("FILE", args->file, "Submitted file: the receipt must be for exactly this file")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--key", args->key,
                     "Public key of the course. Default: course.pub in the folder of the receipt or in the current "
                     "folder, otherwise the key in the receipt.")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->footer(
        "A receipt with a code instead of a signature, from an early version of dynlab, can be verified only by the "
        "course\n"
        "(dynlab course verify).\n"
        "Example:  dynlab verify 00012-group-07-first-report.txt report.pdf --key course.pub\n"
        "Exit codes: 0 genuine, 1 not genuine, or not for the file, 2 wrong usage.");
    command->callback([args, &action] { action = [args] { return verify(*args); }; });
}

}  // namespace dynlab::inline cli
