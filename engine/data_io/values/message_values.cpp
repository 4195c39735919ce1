#include "data_io/values/message_values.h"

#include <stdexcept>

namespace dynlab::inline data_io {

/// More digits than these would not fit into what number_text() has room for.
void check_value(const Number& number, const ValueLimits&) {
    constexpr int kMostDigits = 17;
    const int fewest = number.meaning == Number::Digits::kSignificant ? 1 : 0;
    if (number.digits < fewest || number.digits > kMostDigits)
        throw std::invalid_argument("a number of a message has a senseless number of digits");
}

StoredArgument StoredAs<MessageArgument>::form(const MessageArgument& argument) {
    StoredArgument stored;
    if (const auto* count = std::get_if<std::int64_t>(&argument)) stored.count = *count;
    if (const auto* number = std::get_if<Number>(&argument)) stored.number = *number;
    if (const auto* text = std::get_if<std::string>(&argument)) stored.text = *text;
    if (const auto* option = std::get_if<OptionName>(&argument)) stored.option = option->member;
    if (const auto* list = std::get_if<MessageList>(&argument)) stored.list = *list;
    return stored;
}

MessageArgument StoredAs<MessageArgument>::value(StoredArgument&& form) {
    const int kinds = int{form.count.has_value()} + int{form.number.has_value()} + int{form.text.has_value()} +
                      int{form.option.has_value()} + int{form.list.has_value()};
    if (kinds != 1) throw std::invalid_argument("an argument of a message is of one kind");
    if (form.count) return *form.count;
    if (form.number) return *form.number;
    if (form.text) return std::move(*form.text);
    if (form.option) return OptionName{std::move(*form.option)};
    return std::move(*form.list);
}

Message StoredAs<Message>::value(MessageParts&& form) {
    if (form.id.empty() && !(form.many.empty() && form.arguments.empty()))
        throw std::invalid_argument("a stored message has no format for its arguments");
    return Message::stored(std::move(form.id), std::move(form.many), std::move(form.arguments));
}

}  // namespace dynlab::inline data_io
