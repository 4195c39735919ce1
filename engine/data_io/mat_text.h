#pragma once
#include <matio.h>

#include <string>
#include <vector>

namespace dynlab::inline data_io {

/// Rows of a MATLAB char array (rows x columns, stored column by column) as UTF-8. Throws EnvironmentError when
/// there are fewer characters than the size says.
std::vector<std::string> text_rows(const matvar_t& variable, std::size_t rows, std::size_t columns);

}  // namespace dynlab::inline data_io
