#pragma once
#include <nlohmann/json.hpp>

namespace dynlab::inline course {

/// Reads check files and tries them on a submission, in this process, which should be in a box and is confined here.
/// `job`:
///   {"files": [{"name", "source", "visible"}, ...], "hidden_folder": place, "specimens": {run: {name: number}},
///    "time_ms": most milliseconds for each check, "only": the number of the one that is wanted, or null for all,
///    "submission": {"runs": {"main": ..., rerun: ...}, "findings": [...]} or null to list the checks only}
/// Returns {"checks": [{"id", "about", "hint", "points", "visible", "rerun", "document", "share", "message",
/// "for_instructor"}, ...]}, or {"error": sentence} when a file cannot be read; share, message and for_instructor (see
/// Verdict) are absent when the checks are only listed, and share is null for a check that could not be tried.
nlohmann::json try_checks(const nlohmann::json& job);

}  // namespace dynlab::inline course
