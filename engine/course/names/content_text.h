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

/// Bytes of a code, where a CMap (ISO 32000-1, 9.7.5) gives each code its own number as CID; 0 where it does not, or
/// where that cannot be told.
std::size_t bytes_of_identity(const std::string& cmap);

/// The letter of a glyph's name (Adobe Glyph List: "A", "eacute", "uni00E9", "f_i"); a space for a sign, "" for a name
/// that says nothing.
std::string text_of_glyph(const std::string& name);
/// Whether the name says which letter or sign is shown.
bool is_known_glyph(const std::string& name);

/// The map of a font whose Differences name these glyphs, by code; empty where each letter has the code of ASCII, as
/// such text is read without one.
CodeMap code_map_of_glyphs(const std::vector<std::pair<std::uint32_t, std::string>>& glyphs);

/// Whether a stream is a page's content, or a part of one: it shows text.
bool shows_text(std::string_view stream);

/// A string of a content stream in the codes of some font, or the white space that kerning and moves make, in UTF-8.
struct ShownPiece {
    std::string bytes;
    bool coded = true;
};

/// What stands in a content stream and is not shown: comments, names, tags, words that are no operators, well apart;
/// and what can be read in the bytes of its inline images.
struct UnshownText {
    std::string words, pictures;
};

/// What a content stream shows, visible or not, and the strings of the dictionaries in it, in its own order.
std::vector<ShownPiece> shown_pieces(std::string_view stream, UnshownText* unshown = nullptr);

/// Short strings, such as single letters, in the order in which they stand on the page: along the direction of their
/// text, line by line, with white space where they are apart. Nothing where that is the order they are drawn in.
std::vector<ShownPiece> pieces_by_place(std::string_view stream);

/// The pieces as UTF-8: codes are read with the map, or as Latin letters without one.
std::string shown_text(const std::vector<ShownPiece>& pieces, const CodeMap* map = nullptr);

}  // namespace dynlab::inline course
