#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline platform {

/// Path, size and modification time of an installed file, used instead of its content; empty if there is no such file.
std::string file_stamp(const std::filesystem::path& file);

/// Identity of the running program: the stamps of the program, of the other dynlab programs in its folder and of the
/// loaded variant of its libraries. Stamps are used because hashing megabytes would cost more time than a report.
const std::string& program_identity();

}  // namespace dynlab::inline platform
