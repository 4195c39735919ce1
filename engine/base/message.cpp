#include "base/message.h"

#include <stdexcept>
#include <utility>

namespace dynlab::inline base {
namespace {

/// The digits for which number_text has room.
bool digits_are_possible(const Number& number) {
    const int least = number.meaning == Number::Digits::kSignificant ? 1 : 0;
    return number.digits >= least && number.digits <= 17;
}

}  // namespace

/// Not defaulted: clang 14 to 16 crashes on defaulted comparisons of types that hold each other.
bool MessageList::operator==(const MessageList& other) const {
    return join == other.join && items == other.items;
}

MessageArgument message_argument(double value) {
    return Number{value};
}
MessageArgument message_argument(Number number) {
    return number;
}
MessageArgument message_argument(std::string text) {
    return text;
}
MessageArgument message_argument(std::string_view text) {
    return std::string(text);
}
MessageArgument message_argument(const char* text) {
    return std::string(text);
}
MessageArgument message_argument(OptionName option) {
    return option;
}
MessageArgument message_argument(const Message& message) {
    return MessageList{{message}};
}
MessageArgument message_argument(MessageList list) {
    return list;
}

Message Message::verbatim(std::string text) {
    return text.empty() ? Message() : Message("{}", text);
}

Message Message::stored(std::string id, std::string many, std::vector<MessageArgument> arguments) {
    if (id.empty() && !(many.empty() && arguments.empty()))
        throw std::invalid_argument("an empty message has no arguments");
    for (const std::string& format : {id, many}) {
        std::size_t slots = 0;
        for (std::size_t at = format.find("{}"); at != format.npos; at = format.find("{}", at + 2)) ++slots;
        if (!format.empty() && slots != arguments.size())
            throw std::invalid_argument("a stored message has other arguments than its format");
    }
    if (!many.empty() && (arguments.empty() || !std::holds_alternative<std::int64_t>(arguments.front())))
        throw std::invalid_argument("a stored message with a plural does not begin with a count");
    for (const MessageArgument& argument : arguments)
        if (const auto* number = std::get_if<Number>(&argument); number != nullptr && !digits_are_possible(*number))
            throw std::invalid_argument("a number has at most 17 digits");
    Message message;
    message.id_ = std::move(id);
    message.many_ = std::move(many);
    message.arguments_ = std::move(arguments);
    return message;
}

MessageList listed(const std::vector<std::string>& texts, Join join) {
    MessageList list{{}, join};
    for (const std::string& text : texts) list.items.push_back(Message::verbatim(text));
    return list;
}

Message sentences(std::vector<Message> messages) {
    if (messages.size() == 1) return messages.front();
    return messages.empty() ? Message() : Message("{}", MessageList{std::move(messages), Join::kSentences});
}

}  // namespace dynlab::inline base
