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

struct VerifyWords {
    std::string receipt, key, file;
};

/// The key that was named, or the one that lies beside the receipt or here.
std::optional<PublicKey> key_at_hand(const VerifyWords& words) {
    if (!words.key.empty()) return read_public_key(words.key);
    for (const fs::path& folder : {fs::absolute(words.receipt).parent_path(), fs::current_path()})
        if (fs::exists(folder / kPublicKeyFile)) return read_public_key(folder / kPublicKeyFile);
    return {};
}

int verify(const VerifyWords& words) {
    const std::string text = read_file(words.receipt);
    const std::optional<PublicKey> known = key_at_hand(words);
    const std::string own = key_in_receipt(text);
    ReceiptVerdict verdict = verify_receipt(text, known ? known->digits : own);
    if (verdict.genuine && !words.file.empty() && !is_receipt_for(text, words.file))
        verdict = {false, fmt::format("genuine, but NOT for {}: that file has another SHA-256", words.file)};
    std::string signer;
    if (verdict.genuine)
        signer = known ? fmt::format(", signed by the course \"{}\"", known->course)
                       : fmt::format(
                             ", signed with the key that it names itself:\n{}\nIs that your course's? See its "
                             "{} or its page.",
                             own, kPublicKeyFile);
    std::cout << terminal_text(fmt::format("{}: {}{}{}\n", words.receipt, verdict.reason,
                                           verdict.genuine && !words.file.empty() ? ", for this very file" : "",
                                           signer));
    return verdict.genuine ? kDone : kFailed;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
    auto words = std::make_shared<VerifyWords>();
    CLI::App* command =
        app.add_subcommand("verify", "Check that a course signed a receipt, anywhere, without the course");
    command->add_option("RECEIPT", words->receipt, "The receipt of what was handed in")
        ->required()
        ->check(CLI::ExistingFile);
    command->add_option("FILE", words->file, "What was handed in: the receipt must be for this very file")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--key", words->key,
                     "The course's public key; course.pub beside the receipt or here unless given, else the one that "
                     "the receipt names")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->footer(
        "A receipt of a course of before, with a code instead of a signature, can be verified by the course only\n"
        "(dynlab course verify). Exit code 1: not genuine, or not for the file.\n"
        "Example:  dynlab verify 00012-group-07-first-report.txt report.pdf --key course.pub");
    command->callback([words, &action] { action = [words] { return verify(*words); }; });
}

}  // namespace dynlab::inline cli
