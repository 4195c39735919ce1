#pragma once
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline platform {

/// The candidate nearest to `word` by edit distance (case ignored, swapped neighbors count one), when near
/// enough to be a slip: at most one third of the letters. Nothing otherwise.
std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dynlab::inline platform
