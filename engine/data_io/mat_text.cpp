#include "data_io/mat_text.h"

#include <algorithm>
#include <cstdint>

#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

bool is_high_surrogate(char32_t unit) {
    return unit >= 0xD800 && unit < 0xDC00;
}
bool is_low_surrogate(char32_t unit) {
    return unit >= 0xDC00 && unit < 0xE000;
}

void append_utf8(std::string& out, char32_t code) {
    if (code > 0x10FFFF || is_high_surrogate(code) || is_low_surrogate(code)) code = kReplacement;
    if (code < 0x80) {
        out += static_cast<char>(code);
        return;
    }
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr unsigned kFirst[4] = {0, 0xC0, 0xE0, 0xF0};
    out += static_cast<char>(kFirst[more] | code >> (6 * more));
    for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80 | (code >> (6 * i) & 0x3F));
}

/// Code points of UTF-8; each byte that does not belong to a valid sequence becomes U+FFFD.
std::u32string decode_utf8(const unsigned char* bytes, std::size_t count) {
    std::u32string codes;
    for (std::size_t i = 0; i < count;) {
        const unsigned char first = bytes[i];
        const int more = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : -1;
        char32_t code = more == 0 ? first : first & (0x3Fu >> std::max(more, 0));
        bool valid = more >= 0 && i + static_cast<std::size_t>(std::max(more, 0)) < count;
        for (int k = 1; valid && k <= more; ++k) {
            const unsigned char next = bytes[i + static_cast<std::size_t>(k)];
            valid = next >> 6 == 2;
            code = code << 6 | (next & 0x3F);
        }
        codes += valid ? code : kReplacement;
        i += valid ? static_cast<std::size_t>(more) + 1 : 1;
    }
    return codes;
}

template <class Unit>
std::u32string widen(const void* data, std::size_t bytes) {
    const Unit* units = static_cast<const Unit*>(data);
    return std::u32string(units, units + bytes / sizeof(Unit));
}

std::u32string units_of(const matvar_t& variable) {
    if (!variable.data) return {};
    switch (variable.data_type) {
        case MAT_T_UINT16:
        case MAT_T_INT16:
        case MAT_T_UTF16:
            return widen<std::uint16_t>(variable.data, variable.nbytes);
        case MAT_T_UINT32:
        case MAT_T_INT32:
        case MAT_T_UTF32:
            return widen<std::uint32_t>(variable.data, variable.nbytes);
        case MAT_T_UTF8:
            return decode_utf8(static_cast<const unsigned char*>(variable.data), variable.nbytes);
        default:  // one byte for each character, Latin-1
            return widen<std::uint8_t>(variable.data, variable.nbytes);
    }
}

}  // namespace

std::vector<std::string> text_rows(const matvar_t& variable, std::size_t rows, std::size_t columns) {
    const std::u32string units = units_of(variable);
    if (units.size() < rows * columns) throw EnvironmentError("has fewer characters than its size says");
    std::vector<std::string> texts(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            char32_t code = units[row + rows * column];
            const char32_t next = column + 1 < columns ? units[row + rows * (column + 1)] : 0;
            if (is_high_surrogate(code) && is_low_surrogate(next)) {
                code = 0x10000 + ((code - 0xD800) << 10) + (next - 0xDC00);
                ++column;
            }
            append_utf8(texts[row], code);
        }
    }
    return texts;
}

std::u16string utf16_of(const std::string& text) {
    std::u16string units;
    for (char32_t code : decode_utf8(reinterpret_cast<const unsigned char*>(text.data()), text.size())) {
        if (code < 0x10000) {
            units += static_cast<char16_t>(code);
            continue;
        }
        code -= 0x10000;
        units += static_cast<char16_t>(0xD800 + (code >> 10));
        units += static_cast<char16_t>(0xDC00 + (code & 0x3FF));
    }
    return units;
}

}  // namespace dynlab::inline data_io
