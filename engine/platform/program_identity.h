#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline platform {

/// Path, size and time of writing of an installed file, which stand for its content; empty when there is no such file.
std::string file_stamp(const std::filesystem::path& file);

/// The running program with those beside it, and the variant of its own libraries that was loaded, by their stamps:
/// hashing megabytes would cost more than a whole report.
const std::string& program_identity();

}  // namespace dynlab::inline platform
