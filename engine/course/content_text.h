#pragma once
#include <map>
#include <string>
#include <string_view>

namespace dynlab {

/// What the codes of a font's text mean, as its ToUnicode map says.
struct CodeMap {
    std::size_t bytes = 1;                      ///< of a code
    std::map<std::uint32_t, std::string> text;  ///< UTF-8
};

CodeMap code_map(const std::string& to_unicode);

/// Whether a stream is a page's content, or a part of one: it shows text.
bool shows_text(std::string_view stream);

/// The strings that a content stream shows, in its own order, with the spaces its kerning makes; visible or not. Codes
/// are read with the map, or as Latin letters without one.
std::string content_text(std::string_view stream, const CodeMap* map = nullptr);

}  // namespace dynlab
