#pragma once
#include <string_view>

namespace dynlab::inline documents {

bool is_cell_marker(std::string_view line);                   ///< `-- %%` and its options
bool is_text_cell_marker(std::string_view line);              ///< `-- %% [markdown]` and its options
std::string_view cell_marker_options(std::string_view line);  ///< what follows `-- %%`

}  // namespace dynlab::inline documents
