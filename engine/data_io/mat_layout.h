#pragma once
#include <cstddef>
#include <filesystem>

namespace dynlab::inline data_io {

enum class MatVersion { k4, k5, k73 };

struct MatLayout {
    MatVersion version;
    std::size_t variables = 0;  ///< top-level variables of v4 and v5; 0 for v7.3, whose layout is HDF5's affair
};

/// Looks at the skeleton of a MAT file without reading its variables. Throws EnvironmentError when the file is not
/// a MAT file, is of an unknown version, or ends before its last variable does. References: MathWorks, MAT-File
/// Format (R2022b), chapters 1 (level 5) and 2 (level 4).
MatLayout check_mat_layout(const std::filesystem::path& file);

}  // namespace dynlab::inline data_io
