#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline platform {

/// The text between a token and the previous one.
enum class Gap {
    kNone,    ///< nothing: "Ada2024", ideographs
    kBreak,   ///< a hyphen and the end of the line
    kSpace,   ///< white space
    kNarrow,  ///< up to three signs: "Lovelace, Ada", "ada.lovelace"
    kWide
};

/// A run of letters, a run of digits, or one ideograph of a text, as names are compared.
struct NameToken {
    std::string letters;         ///< folded_letter of each character (platform/utf8.h)
    std::size_t begin, end = 0;  ///< bytes of the text
    bool digits = false, capital = false;
    Gap gap = Gap::kWide;
};

/// How letters are taken.
enum class Reading {
    kPlain,
    kCamel,      ///< a capital within a word begins another: "LovelaceHopper"
    kLookAlike,  ///< letters of other scripts and signs as the Latin ones they look like (platform/text/look_alikes.h)
};

std::vector<NameToken> name_tokens(std::string_view utf8, Reading reading = Reading::kPlain);

/// Whether the tokens are others than those of the plain reading.
bool reads_otherwise(std::string_view utf8, Reading reading);

}  // namespace dynlab::inline platform
