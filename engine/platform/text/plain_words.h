#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// Lower case without accents and ligatures ("Procédé" -> "procede"); characters beyond Latin letters become spaces,
/// except quotation marks and dashes, which become ' and -.
std::string folded(std::string_view utf8);

/// The words of a text, folded: letters and digits. A hyphen joins ("pre-processing" -> "preprocessing"), an apostrophe
/// parts ("l'entrée" -> "l", "entree").
std::vector<std::string> plain_words(std::string_view utf8);

/// The text with control characters and broken UTF-8 as '?', and with at most `max_characters` characters: fit for a
/// terminal.
std::string printable(std::string_view utf8, std::size_t max_characters = 200);

}  // namespace dynlab::inline platform
