#pragma once
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "data_io/values/described.h"

namespace dynlab::inline data_io {

/// Messages as described.h stores them: the id, the plural's id, and each argument under the name of its kind, such as
/// {"number": {"value": 0.05, "digits": 3, "meaning": "significant"}} or {"text": "y1"}. A message that is read again
/// is the same value: its language is chosen then.

constexpr std::array<const char*, 2> names_of(Number::Digits) {
    return {"significant", "decimals"};
}
constexpr std::array<const char*, 6> names_of(Join) {
    return {"comma", "and", "or", "semicolon", "sentences", "lines"};
}

DYNLAB_DESCRIBE(Number, value, digits, meaning)
DYNLAB_DESCRIBE(MessageList, items, join)

/// One of them is there.
struct MessageArgumentMembers {
    std::optional<std::int64_t> count;
    std::optional<Number> number;
    std::optional<std::string> text, option;
    std::optional<MessageList> list;
};

DYNLAB_DESCRIBE(MessageArgumentMembers, count, number, text, option, list)

template <>
struct StoredAs<MessageArgument> {
    using Form = MessageArgumentMembers;
    static Form form(const MessageArgument& argument) {
        Form form;
        if (const auto* count = std::get_if<std::int64_t>(&argument)) form.count = *count;
        if (const auto* number = std::get_if<Number>(&argument)) form.number = *number;
        if (const auto* text = std::get_if<std::string>(&argument)) form.text = *text;
        if (const auto* option = std::get_if<OptionName>(&argument)) form.option = option->member;
        if (const auto* list = std::get_if<MessageList>(&argument)) form.list = *list;
        return form;
    }
    static MessageArgument value(Form&& form) {
        std::optional<MessageArgument> argument;
        const auto take = [&argument](auto&& member) {
            if (argument) throw std::invalid_argument("an argument of a message is of one kind");
            argument = std::forward<decltype(member)>(member);
        };
        if (form.count) take(*form.count);
        if (form.number) take(*form.number);
        if (form.text) take(std::move(*form.text));
        if (form.option) take(OptionName{std::move(*form.option)});
        if (form.list) take(std::move(*form.list));
        if (!argument) throw std::invalid_argument("an argument of a message is of no known kind");
        return std::move(*argument);
    }
};

struct MessageMembers {
    std::string id, many;
    std::vector<MessageArgument> arguments;
};

template <Is<MessageMembers> T, class V>
void describe(T& object, V& member) {
    auto& [id, many, arguments] = object;
    member("id", id), member.unless_empty("many", many), member.unless_empty("arguments", arguments);
}

template <>
struct StoredAs<Message> {
    using Form = MessageMembers;
    static Form form(const Message& message) { return {message.id(), message.many(), message.arguments()}; }
    static Message value(Form&& form) {
        return Message::stored(std::move(form.id), std::move(form.many), std::move(form.arguments));
    }
};

}  // namespace dynlab::inline data_io
