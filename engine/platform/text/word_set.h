#pragma once
#include <string_view>
#include <unordered_set>

namespace dynlab::inline platform {

/// The words of a list with one blank between them; they stay where the list is.
std::unordered_set<std::string_view> word_set(std::string_view list);

}  // namespace dynlab::inline platform
