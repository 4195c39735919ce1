#pragma once
#include <string>
#include <vector>

namespace dynlab::inline course {

/// What a comparison of two texts goes by: without spaces, the hyphens inside words (a line's end may have put them
/// there) and the kinds of quotation marks. Never holds a line end.
std::string comparison_key(const std::string& text);

/// How to get from one list to the other, a letter a step: '=' an item that both have (by comparison_key), '-' one of
/// `before` only, '+' one of `after` only. The shortest way where that has at most kMostEdits steps but '='; longer
/// ones are put together of such pieces, each the one that leads furthest.
constexpr int kMostEdits = 4000;
std::string edit_script(const std::vector<std::string>& before, const std::vector<std::string>& after);

}  // namespace dynlab::inline course
