#pragma once
#include <string>

namespace dynlab::inline workflow {

/// Markdown whose wide pipe tables say in their rules ("|---|---|") how wide each column is to be: Pandoc shares the
/// width of a table with a line of more than 72 characters as the dashes are. A column has the length of its longest
/// cell where that is no more than its part of the width; the others share what is left in that proportion, none more
/// than four times as wide as another of them. Lines keep their places; code and narrow tables stay as they are.
std::string with_fitted_columns(const std::string& markdown);

}  // namespace dynlab::inline workflow
