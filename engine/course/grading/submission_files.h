#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline course {

struct Pack {
    std::vector<std::string> files;     ///< in the pack, MANIFEST.json aside
    std::vector<std::string> left_out;  ///< links, and what is neither file nor folder
    std::string hash;                   ///< SHA-256 of the pack
};

/// Packs a student's folder into one zip for submission: its files without the data link, hidden entries and earlier
/// packs, and MANIFEST.json with the SHA-256 of each. Equal folders give equal packs. Throws EnvironmentError for a
/// folder without analysis.lua, or one that is too large.
Pack pack_folder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace dynlab::inline course
