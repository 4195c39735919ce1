#include "course/sandbox_jobs/sandbox_messages.h"

#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/reader.h"
#include "documents/error.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

using Change = std::function<std::string(const std::string&)>;

Message with_changed_arguments(const Message& message, const Change& change) {
    std::vector<MessageArgument> arguments = message.arguments();
    for (MessageArgument& argument : arguments) {
        if (auto* const text = std::get_if<std::string>(&argument)) *text = change(*text);
        if (auto* const list = std::get_if<MessageList>(&argument))
            for (Message& item : list->items) item = with_changed_arguments(item, change);
    }
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

}  // namespace

Message with_changed_text(const Message& message, const Change& change) {
    if (message.empty()) return message;
    Message changed = with_changed_arguments(message, change);
    std::string requested = change(message_text(message));
    return message_text(changed) == requested ? changed : Message::verbatim(std::move(requested));
}

std::string without_sandbox_paths(const std::string& said, const std::filesystem::path& folder) {
    constexpr std::string_view kProgramSays = "dynlab: ";
    const std::string reported = said.starts_with(kProgramSays) ? said.substr(kProgramSays.size()) : said;
    return replaced(reported, folder.string() + "/", "");
}

Message without_sandbox_paths(const Message& said, const std::filesystem::path& folder) {
    return with_changed_text(said, [&folder](const std::string& text) { return without_sandbox_paths(text, folder); });
}

Message with_place(const RecordedError& error) {
    return error.line > 0 ? placed({error.file, error.line}, error.message) : error.message;
}

Message shortened_error(const Message& error_reason) {
    constexpr std::size_t kMaxLength = 2000;
    return with_changed_text(error_reason, [](const std::string& text) {
        return text.size() > kMaxLength ? text.substr(0, kMaxLength) + " ..." : text;
    });
}

std::string without_full_stop(std::string text) {
    while (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace dynlab::inline course
