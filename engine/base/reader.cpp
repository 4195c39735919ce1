#include "base/reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "base/catalog.h"
#include "base/number_text.h"

namespace dynlab::inline base {
namespace {

std::string with_decimal_sign(std::string number, const Reader& reader) {
    if (reader.catalog == nullptr) return number;
    if (const std::size_t point = number.find('.'); point != number.npos)
        number.replace(point, 1, reader.catalog->decimal_sign());
    return number;
}

std::string fixed(double value, int digits) {
    if (!std::isfinite(value)) return number_text(value);
    std::array<char, 400> characters{};
    const auto end = std::to_chars(characters.data(), characters.data() + characters.size(), value,
                                   std::chars_format::fixed, digits);
    std::string text(characters.data(), end.ptr);
    if (text.starts_with('-') && text.find_first_of("123456789") == text.npos) text.erase(0, 1);  // no "-0.0"
    return text;
}

std::string joined(const MessageList& list, const Reader& reader) {
    static constexpr std::array<const char*, 6> kBetween = {", ", " and ", " or ", "; ", " ", "\n"};
    const auto between = [&reader](Join join) {
        const std::string english = kBetween[static_cast<std::size_t>(join)];
        return reader.catalog == nullptr ? english : reader.catalog->list_separator(english);
    };
    std::string all;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
        const bool last = i + 1 == list.items.size();
        const bool enumeration = list.join == Join::kAnd || list.join == Join::kOr;
        if (i > 0) all += between(enumeration && !last ? Join::kComma : list.join);
        all += message_text(list.items[i], reader);
    }
    return all;
}

std::string argument_text(const MessageArgument& argument, const Reader& reader) {
    if (const auto* count = std::get_if<std::int64_t>(&argument)) return std::to_string(*count);
    if (const auto* number = std::get_if<Number>(&argument)) return number_text(*number, reader);
    if (const auto* verbatim = std::get_if<std::string>(&argument)) return *verbatim;
    if (const auto* option = std::get_if<OptionName>(&argument))
        return reader.option_name == nullptr ? "`" + option->member + "`" : reader.option_name(option->member);
    return joined(std::get<MessageList>(argument), reader);
}

std::size_t slots_in(std::string_view format) {
    std::size_t slots = 0;
    for (std::size_t at = format.find("{}"); at != format.npos; at = format.find("{}", at + 2)) ++slots;
    return slots;
}

/// The format in the reader's language, and in its plural form.
std::string_view format_of(const Message& message, const Reader& reader) {
    const bool counted = !message.many().empty();
    const std::int64_t count = counted ? std::get<std::int64_t>(message.arguments().front()) : 1;
    const std::string_view english = counted && count != 1 ? message.many() : message.id();
    if (reader.catalog == nullptr) return english;
    const std::string_view other =
        counted ? reader.catalog->plural(message.id(), count) : reader.catalog->translation(message.id());
    return other.empty() || slots_in(other) != message.arguments().size() ? english : other;
}

}  // namespace

std::string number_text(const Number& number, const Reader& reader) {
    const bool significant = number.meaning == Number::Digits::kSignificant;
    return with_decimal_sign(
        significant ? number_text(number.value, number.digits) : fixed(number.value, number.digits), reader);
}

std::string message_text(const Message& message, const Reader& reader) {
    const std::string_view format = format_of(message, reader);
    std::string result;
    std::size_t begin = 0;
    for (const MessageArgument& argument : message.arguments()) {
        const std::size_t slot = format.find("{}", begin);
        result.append(format, begin, slot - begin).append(argument_text(argument, reader));
        begin = slot + 2;
    }
    return result.append(format, begin);
}

}  // namespace dynlab::inline base
