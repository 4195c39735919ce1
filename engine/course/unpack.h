#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace dynlab {

/// Unpacks an archive (zip, tar, with or without compression) for grading, in this process, which should be in a box
/// and is confined here. `job`: {"archive": place, "to": place of an empty folder, "bytes": most bytes, "files": most
/// files, "keep_times": whether files keep theirs}. Only files and folders come out, below `to`; rights are not kept.
/// Returns {"left_out": [names]} of what was something else, absolute or led outside, or {"error": sentence}.
nlohmann::json unpack_archive(const nlohmann::json& job);

}  // namespace dynlab
