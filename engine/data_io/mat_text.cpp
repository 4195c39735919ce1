#include "data_io/mat_text.h"

#include <cstdint>

#include "platform/error.h"
#include "platform/utf8.h"

namespace dynlab::inline data_io {
namespace {

template <class Unit>
std::u32string widen(const void* data, std::size_t bytes) {
    const Unit* units = static_cast<const Unit*>(data);
    return std::u32string(units, units + bytes / sizeof(Unit));
}

/// Characters, or units of UTF-16 where it stores those.
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
            return characters_in({static_cast<const char*>(variable.data), variable.nbytes});
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
        std::u16string text;
        for (std::size_t column = 0; column < columns; ++column) {
            const char32_t unit = units[row + rows * column];
            if (unit < 0x10000)
                text += static_cast<char16_t>(unit);
            else
                text += utf16_of(utf8_of(unit));
        }
        texts[row] = utf8_of(text);
    }
    return texts;
}

}  // namespace dynlab::inline data_io
