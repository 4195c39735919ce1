#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "documents/words/characters.h"

namespace dynlab::inline documents {

/// Whether pdflatex can set a text, and what LuaLaTeX needs where it cannot. Greek letters are symbols to pdflatex,
/// so that a word of them is one that it cannot set.

/// The first character of `text` that pdflatex cannot set.
std::optional<char32_t> first_beyond(const PrintableCharacters& pdflatex, std::string_view text);

/// The scripts of the text's letters as report_templates/latex/unicode.tex takes them: "Arabic=arab", "Han=hani". Latin
/// is not named, and Greek only where the text has words of it.
std::set<std::string> scripts_of(const PrintableCharacters& pdflatex, std::string_view text);

/// The text without the signs that only direct it, which have a meaning beside right-to-left letters alone.
std::string without_directions(std::string_view text);

/// The characters of `text` beyond ASCII: those that mathematics does not know are set as text in formulas.
std::set<char32_t> characters_beyond_ascii(std::string_view text);

/// LaTeX text with U+200E around each right-to-left phrase, so that the numbers and signs beside a name keep their
/// places, and in a box in rows of tables, so that the cell keeps its alignment. Targets of links stay as they are.
std::string with_direction_marks(std::string_view latex);

/// The text with "?" for each of these letters; accents are left out.
std::string without_letters(std::string_view text, const std::set<char32_t>& letters);

/// The single characters of `text` that pdflatex cannot set.
std::set<char32_t> letters_beyond(const PrintableCharacters& pdflatex, std::string_view text);

}  // namespace dynlab::inline documents
