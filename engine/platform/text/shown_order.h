#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// A line of text in the order in which a viewer shows it where signs in it turn the direction (U+202A to U+202E,
/// U+2066 to U+2069; UAX #9), without these signs: "\u202Ecba" -> "abc". Other text as it is.
std::string in_shown_order(std::string_view utf8);

}  // namespace dynlab::inline platform
