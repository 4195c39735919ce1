#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace dynlab::inline course {

/// Unpacks an archive (zip, tar, with or without compression) for grading, in this process, which should be in a box
/// and is confined here. `job`: {"archive": place, "to": place of an empty folder, "bytes": most bytes, "files": most
/// files, "keep_times": whether files keep theirs}. Only files and folders come out, below `to`; rights are not kept.
/// Names in UTF-8 become names in UTF-8, other bytes of a name stay as they are. Returns {"left_out": [clauses]}, what
/// did not come out and why ("\"../x\" leads outside of the archive"), or {"error": sentence}.
nlohmann::json unpack_archive(const nlohmann::json& job);

}  // namespace dynlab::inline course
