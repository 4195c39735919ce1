#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline course {

/// Whether the bytes are a text, in UTF-8 or in UTF-16 with its mark, as a whole.
bool is_text(std::string_view bytes);

/// What can be read in bytes of any kind, as UTF-8: a text as it is; else the runs of at least four printable
/// characters in ASCII, UTF-8 and UTF-16, each on a line.
std::string text_in(std::string_view bytes);

/// Character references of XML and HTML 4 (&#xE9; &amp; &eacute;) as the characters; U+FFFD for a number that is
/// no character's. Other text stays as it is.
std::string without_references(const std::string& xml);

/// Names and contents of an archive's entries (zip, as word processors write them, tar, gzip), one after the other;
/// empty for bytes that are not an archive.
std::vector<std::string> texts_of_archive(const std::string& bytes);

/// What compressed pieces inside the bytes hold (text chunks of PNG).
std::vector<std::string> compressed_inside(std::string_view bytes);

}  // namespace dynlab::inline course
