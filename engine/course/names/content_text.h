#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline course {

/// What the codes of a font's text mean, as its ToUnicode map says.
struct CodeMap {
    std::size_t bytes = 1;                      ///< of a code
    std::map<std::uint32_t, std::string> text;  ///< UTF-8
    bool operator==(const CodeMap&) const = default;
};

CodeMap code_map(const std::string& to_unicode);

/// Whether a stream is a page's content, or a part of one: it shows text.
bool shows_text(std::string_view stream);

/// A string of a content stream in the codes of some font, or the white space that kerning and moves make, in UTF-8.
struct ShownPiece {
    std::string bytes;
    bool coded = true;
};

/// What a content stream shows, visible or not, and the strings of the dictionaries in it, in its own order.
std::vector<ShownPiece> shown_pieces(std::string_view stream);

/// The pieces as UTF-8: codes are read with the map, or as Latin letters without one.
std::string shown_text(const std::vector<ShownPiece>& pieces, const CodeMap* map = nullptr);

}  // namespace dynlab::inline course
