#include "data_io/tables/text_decoding.h"

#include <algorithm>
#include <array>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline data_io {
namespace {

/// The characters of the bytes 0x80 to 0x9F in Windows-1252; every other byte is the character with the same number.
constexpr std::array<char32_t, 32> kWindowsCharacters = {
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

std::string from_windows(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() + bytes.size() / 8);
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80)
            text += c;
        else
            text += utf8_of(byte < 0xA0 ? kWindowsCharacters[byte - 0x80] : static_cast<char32_t>(byte));
    }
    return text;
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
    std::u16string units;
    units.reserve(bytes.size() / 2);
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        const auto first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
        units += static_cast<char16_t>(big_endian ? first << 8 | second : second << 8 | first);
    }
    return utf8_of(units);
}

/// Place of the first byte that is no UTF-8.
std::size_t end_of_utf8(std::string_view text) {
    std::string_view rest = text;
    while (!rest.empty()) {
        if (static_cast<unsigned char>(rest.front()) < 0x80) {
            rest.remove_prefix(1);
            continue;
        }
        const std::string_view before = rest;
        if (!take_character(rest)) return text.size() - before.size();
    }
    return std::string_view::npos;
}

/// The word around a place, to show how it was read.
std::string_view word_around(std::string_view text, std::size_t place) {
    constexpr std::string_view kEnds = " \t\r\n,;\"|()[]";
    constexpr std::size_t kFarthest = 20;
    std::size_t begin = place, end = place;
    while (begin > 0 && place - begin < kFarthest && kEnds.find(text[begin - 1]) == std::string_view::npos) --begin;
    while (end < text.size() && end - place < kFarthest && kEnds.find(text[end]) == std::string_view::npos) ++end;
    return text.substr(begin, end - begin);
}

}  // namespace

std::string decoded_text(const std::filesystem::path& file, std::string bytes, std::vector<Message>& notes) {
    const std::string_view begin = std::string_view(bytes).substr(0, 2);
    if (begin == "\xFF\xFE" || begin == "\xFE\xFF") bytes = from_utf16(bytes, begin == "\xFE\xFF");
    bytes.erase(0, bytes.size() - without_byte_order_mark(bytes).size());
    if (bytes.find('\0') != std::string::npos)
        throw EnvironmentError("{}: the file contains bytes that are not text; export the table as CSV in UTF-8",
                               file.string());
    if (const std::size_t place = end_of_utf8(bytes); place != std::string::npos) {
        const std::string word = from_windows(word_around(bytes, place));
        bytes = from_windows(bytes);
        notes.push_back(Message("the text is not UTF-8 and was read as Windows-1252, for example \"{}\"", word));
    }
    if (bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
    return bytes;
}

}  // namespace dynlab::inline data_io
