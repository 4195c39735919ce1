#include "documents/lua_text.h"

#include <fmt/format.h>

namespace dynlab::inline documents {

std::string lua_text(std::string_view text) {
    std::string literal = "\"";
    for (const char character : text) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x20 || byte == 0x7F) {
            literal += fmt::format("\\{:03}", byte);
        } else {
            if (character == '"' || character == '\\') literal += '\\';
            literal += character;
        }
    }
    return literal + '"';
}

}  // namespace dynlab::inline documents
