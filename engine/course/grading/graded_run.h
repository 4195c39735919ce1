#pragma once
#include <nlohmann/json.hpp>

namespace dynlab::inline course {

/// Runs a student's script for grading, in this process, which should be in a box and is confined here. The data are
/// those of DYNLAB_HOME. `job`:
///   {"script": place, "seed": whole number, "answers": [[name, kind], ...] as the lesson declares them,
///    "time_ms": most milliseconds, "memory_bytes": most bytes of the script}
/// Returns what the checks may see:
///   {"answers": {name: value}, "figures": {name: caption}, "values": {name: {...}}, "tables": [names], "texts":
///   [names],
///    "printed": the end of what it printed, "error": message or absent,
///    "seconds": that the script took}
/// A script that cannot be read at all has an "error" and nothing else.
nlohmann::json run_for_grading(const nlohmann::json& job);

}  // namespace dynlab::inline course
