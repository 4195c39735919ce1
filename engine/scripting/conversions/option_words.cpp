#include "scripting/conversions/option_words.h"

#include <utility>
#include <variant>

#include "base/reader.h"
#include "platform/spelling.h"

namespace dynlab::inline scripting {
Message with_script_options(const Message& message, const Reader& reader) {
    std::vector<MessageArgument> arguments = message.arguments();
    for (MessageArgument& argument : arguments) {
        if (const auto* const option = std::get_if<OptionName>(&argument)) {
            argument = message_text(Message("{}", *option), reader);
        } else if (auto* const list = std::get_if<MessageList>(&argument)) {
            for (Message& item : list->items) item = with_script_options(item, reader);
        }
    }
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

Message unknown_option(const std::string& name, const std::vector<std::string>& known) {
    const auto near = nearest_word(name, known);
    return near ? Message("unknown option '{}'; did you mean '{}'?", name, *near)
                : Message("unknown option '{}'; the options are {}", name, listed(known));
}

MessageList listed_in_quotes(const std::vector<std::string>& texts) {
    MessageList list;
    for (const std::string& text : texts) list.items.push_back(Message::verbatim('"' + text + '"'));
    return list;
}

}  // namespace dynlab::inline scripting
