#pragma once
#include <filesystem>

#include "data_io/variable.h"

namespace dynlab::inline data_io {

/// Reads a JSON file whose outermost value is an object: numbers, texts and truth values unchanged, lists of numbers as
/// vectors, lists of equally long lists of numbers as matrices (row by row), objects as structs, all other lists as
/// lists. null means a missing number (NaN). Throws EnvironmentError that names the file, and the line and column of
/// invalid JSON: more than 64 MB, more than 100 levels, another outermost value, a name twice.
VariableTable read_json_file(const std::filesystem::path& file);

/// Writes such a file, whole or not at all, the same bytes for the same variables; numbers have 17 digits, and those
/// that are not finite are null; a matrix of one row is a list like a vector. Throws EnvironmentError when the file
/// cannot be written.
void write_json_file(const std::filesystem::path& file, const VariableTable& variables);

}  // namespace dynlab::inline data_io
