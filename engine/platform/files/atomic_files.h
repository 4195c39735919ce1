#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline platform {

struct NewFile {
    std::filesystem::path file;
    std::string content;
};

/// As write_file_atomically (platform/atomic_file.h) for each, in their order: each appears whole or not at all, and
/// none before those that stand before it. They wait for the disk together, which takes little longer than for one.
void write_files_atomically(const std::vector<NewFile>& files);

}  // namespace dynlab::inline platform
