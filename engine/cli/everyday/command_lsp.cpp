#include <charconv>
#include <iostream>

#include "cli/commands.h"
#include "documents/text_lines.h"
#include "scripting/lint/language_server.h"

namespace dynlab::inline cli {
namespace {

constexpr std::size_t kMaxByteCount = 64u << 20;  // of a message

/// The next message behind its header; nothing at the end of the input or for a header that is none.
std::optional<std::string> next_message(std::istream& input) {
    constexpr std::string_view kLength = "Content-Length: ";
    std::size_t length = 0;
    for (std::string line; std::getline(input, line);) {
        line = trimmed(line);
        if (line.empty()) {
            if (length == 0 || length > kMaxByteCount) return std::nullopt;
            std::string message(length, '\0');
            return input.read(message.data(), static_cast<std::streamsize>(length)) ? std::optional(message)
                                                                                    : std::nullopt;
        }
        if (line.starts_with(kLength)) std::from_chars(line.data() + kLength.size(), line.data() + line.size(), length);
    }
    return std::nullopt;
}

int serve() {
    LanguageServer server;
    while (!server.ended()) {
        const auto message = next_message(std::cin);
        if (!message) break;
        for (const nlohmann::json& answer : server.answers_to(*message)) {
            const std::string text = answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
            std::cout << "Content-Length: " << text.size() << "\r\n\r\n" << text << std::flush;
        }
    }
    return server.ended_well() ? kDone : kFailed;
}

}  // namespace

void add_lsp(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("lsp", "Run the language server for an editor");
    command->footer(
        "Editors start this command. It reports errors while you type, completes names and shows help. See dynlab "
        "help\nguide-editors.\nExit codes: 0 the editor shut down the server, 1 the connection ended earlier, 2 wrong "
        "usage.");
    command->callback([&action] { action = serve; });
}

}  // namespace dynlab::inline cli
