#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace dynlab::inline scripting {

/// Plain text filled into lines of at most `width` columns of a terminal, all but the first indented. A longer word
/// gets a separate, unbroken line. The last line has no line end.
std::string filled(std::string_view text, std::size_t width, std::size_t indent = 0);

/// A help page (Markdown: headings, paragraphs, lists, tables, code) as a terminal shows it: filled to the width,
/// tables in columns, code indented, without the marks. Code and words that are longer than a line stay as they are.
std::string laid_out(std::string_view markdown, std::size_t width);

}  // namespace dynlab::inline scripting
