#include "course/boxes/told_reason.h"

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
    std::string wanted = change(message_text(message));
    return message_text(changed) == wanted ? changed : Message::verbatim(std::move(wanted));
}

std::string told_outside(const std::string& said, const std::filesystem::path& folder) {
    constexpr std::string_view kProgramSays = "dynlab: ";
    const std::string told = said.starts_with(kProgramSays) ? said.substr(kProgramSays.size()) : said;
    return replaced(told, folder.string() + "/", "");
}

Message told_outside(const Message& said, const std::filesystem::path& folder) {
    return with_changed_text(said, [&folder](const std::string& text) { return told_outside(text, folder); });
}

Message with_place(const RecordedError& error) {
    return error.line > 0 ? placed({error.file, error.line}, error.message) : error.message;
}

Message shortened_trouble(const Message& trouble) {
    constexpr std::size_t kLongest = 2000;
    return with_changed_text(trouble, [](const std::string& text) {
        return text.size() > kLongest ? text.substr(0, kLongest) + " ..." : text;
    });
}

std::string without_full_stop(std::string text) {
    while (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace dynlab::inline course
