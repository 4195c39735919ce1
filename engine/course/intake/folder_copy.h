#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// The folder of the figures that dynlab run saved for analysis.lua: it draws them again, and they are no report.
inline constexpr const char* kFiguresOfRuns = "analysis_out";

struct FolderCopy {
    bool too_large = false;             ///< a limit was passed; the copy is not whole
    std::vector<std::string> left_out;  ///< links, and what is neither file nor folder, by their path in the folder
};

/// Copies files and folders, hidden ones excepted, into `to`, an empty folder. The link `data` that dynlab new makes
/// leads to the course's data, whatever it led to before. No other link is followed or copied. Files keep their times.
FolderCopy copy_folder(const std::filesystem::path& from, const std::filesystem::path& to, std::uint64_t max_bytes,
                       int max_files);

/// All plain files below, sorted; without links, hidden ones and what systems add (__MACOSX).
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// The content of all files below, without links, by their path there.
std::map<std::string, std::string> contents_of(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
