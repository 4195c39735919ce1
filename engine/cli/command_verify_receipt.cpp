#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "course/store/course_key.h"
#include "course/store/receipts.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline cli {
namespace {

namespace fs = std::filesystem;

struct VerifyWords {
    std::vector<std::string> receipts;
    std::string key, file;
};

/// The key that was named, or the one that lies beside the receipt or here.
fs::path key_file(const VerifyWords& words) {
    if (!words.key.empty()) return words.key;
    for (const fs::path& folder : {fs::absolute(words.receipts.front()).parent_path(), fs::current_path()})
        if (fs::exists(folder / kPublicKeyFile)) return folder / kPublicKeyFile;
    throw EnvironmentError(
        fmt::format("there is no {} beside the receipt or here: get it from your course, and name it with --key FILE",
                    kPublicKeyFile));
}

int verify_receipts(const VerifyWords& words) {
    const PublicKey key = read_public_key(key_file(words));
    bool well = true;
    for (const std::string& name : words.receipts) {
        const std::string text = read_file(name);
        ReceiptVerdict verdict = verify_receipt(text, key.digits);
        if (verdict.genuine && !words.file.empty() && !is_receipt_for(text, words.file))
            verdict = {false, fmt::format("genuine, but NOT for {}: that file has another SHA-256", words.file)};
        std::cout << terminal_text(
            fmt::format("{}: {}{}\n", name, verdict.reason,
                        verdict.genuine ? fmt::format(", signed by the course \"{}\"", key.course) : std::string()));
        well = well && verdict.genuine;
    }
    return well ? kDone : kFailed;
}

}  // namespace

void add_verify_receipt(CLI::App& app, Action& action) {
    auto words = std::make_shared<VerifyWords>();
    CLI::App* command =
        app.add_subcommand("verify-receipt", "Check that a course signed a receipt, by its public key alone");
    command->add_option("RECEIPT", words->receipts, "Receipts of what was handed in")
        ->required()
        ->check(CLI::ExistingFile);
    command
        ->add_option("--key", words->key, "The course's public key; course.pub beside the receipt or here unless given")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->add_option("--file", words->file, "What was handed in: the receipt must be for this very file")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->footer(
        "The course itself is not needed; it verifies with dynlab course verify. Exit code 1: not genuine.\n"
        "Example:  dynlab verify-receipt 00012-group-07-first-report.txt --key course.pub --file report.pdf");
    command->callback([words, &action] { action = [words] { return verify_receipts(*words); }; });
}

}  // namespace dynlab::inline cli
