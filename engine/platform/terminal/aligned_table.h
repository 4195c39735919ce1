#pragma once
#include <string>
#include <vector>

namespace dynlab::inline platform {

/// A table for a terminal: columns as wide as their widest cell (counted in columns of the terminal, control
/// characters shown as ?), two blanks between, a line below the header; the last column is not filled up.
std::string aligned_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

}  // namespace dynlab::inline platform
