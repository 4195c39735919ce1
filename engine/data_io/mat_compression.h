#pragma once
#include <filesystem>

namespace dynlab::inline data_io {

/// A MAT v5 file beside `file` in which its large uncompressed variables are deflated at the fastest level, or `file`
/// itself when there is nothing to gain: a variable of which a part does not shrink by a seventh stays as it is, for
/// noise in double precision costs half a second and saves four bytes in a hundred. Throws EnvironmentError when the
/// new file cannot be written. Reference: MathWorks, MAT-File Format (R2022b), chapter 1, miCOMPRESSED.
std::filesystem::path with_quick_compression(const std::filesystem::path& file);

/// Whether all that the tags of a MAT v5 file announce is there: libmatio does not notice every failed write, and the
/// tags that it sets afterwards fit what a full disk has left.
bool is_whole(const std::filesystem::path& file);

}  // namespace dynlab::inline data_io
