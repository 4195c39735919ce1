#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "course/anonymity/name_patterns.h"

namespace dynlab::inline course {

/// How a text is read.
enum class TextManner {
    kProse,  ///< sentences: a name that is also a word counts only with its capital
    kData    ///< metadata, file names, links, bookmarks: case does not matter
};

struct PatternMatch {
    std::size_t end = 0;  ///< one past the last token
    bool parted = false;  ///< white space is within a word
};

/// Whether the tokens from `first` on read as the pattern.
std::optional<PatternMatch> match_pattern(const NamePattern& pattern, const std::vector<NameToken>& tokens,
                                          std::size_t first, std::string_view text, TextManner manner);

/// Whether a word such as "student" or "ID" is before a token.
bool is_labeled(const std::vector<NameToken>& tokens, std::size_t first);

}  // namespace dynlab::inline course
