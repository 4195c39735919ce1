#pragma once
#include <optional>

#include "base/message.h"
#include "data_io/values/described.h"

namespace dynlab::inline data_io {

/// Messages as described.h stores them. A message that is read again is the same value: its id finds the translation of
/// the language that is asked for then, which text would not.

constexpr std::array<const char*, 2> names_of(Number::Digits) {
    return {"significant", "decimals"};
}

constexpr std::array<const char*, 6> names_of(Join) {
    return {"comma", "and", "or", "semicolon", "sentences", "lines"};
}

DYNLAB_DESCRIBE(Number, value, digits, meaning)
void check_value(const Number& number, const ValueLimits& limits);

DYNLAB_DESCRIBE(MessageList, items, join)

/// Exactly one of these has a value.
struct StoredArgument {
    std::optional<std::int64_t> count;
    std::optional<Number> number;
    std::optional<std::string> text, option;
    std::optional<MessageList> list;
};

DYNLAB_DESCRIBE(StoredArgument, count, number, text, option, list)

template <>
struct StoredAs<MessageArgument> {
    using Form = StoredArgument;
    static Form form(const MessageArgument& argument);
    static MessageArgument value(Form&& form);
};

struct MessageParts {
    std::string id, many;
    std::vector<MessageArgument> arguments;
};

template <Is<MessageParts> T, class V>
void describe(T& object, V& member) {
    auto& [id, many, arguments] = object;
    member("id", id), member.unless_empty("many", many), member.unless_empty("arguments", arguments);
}

template <>
struct StoredAs<Message> {
    using Form = MessageParts;
    static Form form(const Message& message) { return {message.id(), message.many(), message.arguments()}; }
    static Message value(Form&& form);
};

}  // namespace dynlab::inline data_io
