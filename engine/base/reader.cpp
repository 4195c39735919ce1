#include "base/reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <vector>

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
    static constexpr std::array<const char*, 6> kBetween = {
        marked("list", ", "), marked("list", " and "), marked("list", " or "), marked("list", "; "), " ", "\n"};
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

/// Where a format takes which argument, in the order of the text.
struct Slot {
    std::size_t begin, size, argument;
};

std::vector<Slot> slots_in(std::string_view format) {
    std::vector<Slot> slots;
    for (std::size_t at = format.find("{}"); at != format.npos; at = format.find("{}", at + 2))
        slots.push_back({at, 2, slots.size()});
    return slots;
}

/// A translation may take the arguments in another order than English, all by their numbers: "{2} de {1}".
std::vector<Slot> slots_in_translation(std::string_view format, std::size_t arguments) {
    std::vector<Slot> slots = slots_in(format);
    for (std::size_t i = 0; i < arguments && slots.size() <= i; ++i) {
        const std::string slot = "{" + std::to_string(i + 1) + "}";
        const std::size_t at = format.find(slot);
        if (at == format.npos) break;
        slots.push_back({at, slot.size(), i});
    }
    std::sort(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) { return a.begin < b.begin; });
    return slots;
}

/// The translation of a message that is an author's text and nothing else; empty where there is none.
std::string_view translation_of_author(const Message& message, const Reader& reader) {
    if (reader.authors == nullptr || message.id() != "{}") return {};
    const auto* const text = std::get_if<std::string>(&message.arguments().front());
    return text == nullptr ? std::string_view() : reader.authors->translation(*text);
}

struct Format {
    std::string text;
    std::vector<Slot> slots;
};

}  // namespace

std::string with_first_letter(std::string text, bool capital) {
    const auto change = [capital](char& c, char first, char last) {
        const char low = capital ? first : static_cast<char>(first - 0x20);
        if (c >= low && c <= low + (last - first)) c = static_cast<char>(capital ? c - 0x20 : c + 0x20);
    };
    if (!text.empty()) change(text[0], 'a', 'z');
    if (text.size() > 1 && text[0] == '\xC3') change(text[1], '\xA0', '\xBE');  // à to þ in UTF-8
    return text;
}

namespace {

/// The translation of an id. Behind a colon a sentence goes on with a small letter: its id is that with a capital one.
std::string translation_of(const Message& message, const Catalog& catalog) {
    const auto look = [&](const std::string& id) {
        return message.many().empty() ? catalog.translation(id)
                                      : catalog.plural(id, std::get<std::int64_t>(message.arguments().front()));
    };
    if (const std::string_view other = look(message.id()); !other.empty()) return std::string(other);
    return with_first_letter(std::string(look(with_first_letter(message.id(), true))), false);
}

/// In the reader's language, and in its plural form.
Format format_of(const Message& message, const Reader& reader) {
    const bool counted = !message.many().empty();
    const std::int64_t count = counted ? std::get<std::int64_t>(message.arguments().front()) : 1;
    const std::string_view english = counted && count != 1 ? message.many() : message.id();
    if (reader.catalog != nullptr) {
        const std::string other = translation_of(message, *reader.catalog);
        const std::vector<Slot> slots = slots_in_translation(other, message.arguments().size());
        if (!other.empty() && slots.size() == message.arguments().size()) return {other, slots};
    }
    return {std::string(english), slots_in(english)};
}

}  // namespace

std::string number_text(const Number& number, const Reader& reader) {
    const bool significant = number.meaning == Number::Digits::kSignificant;
    return with_decimal_sign(
        significant ? number_text(number.value, number.digits) : fixed(number.value, number.digits), reader);
}

std::string message_text(const Message& message, const Reader& reader) {
    if (const std::string_view text = translation_of_author(message, reader); !text.empty()) return std::string(text);
    const Format format = format_of(message, reader);
    std::string result;
    std::size_t begin = 0;
    for (const Slot& slot : format.slots) {
        result.append(format.text, begin, slot.begin - begin);
        result.append(argument_text(message.arguments()[slot.argument], reader));
        begin = slot.begin + slot.size;
    }
    return result.append(format.text, begin);
}

}  // namespace dynlab::inline base
