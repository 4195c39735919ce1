#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_run.h"
#include "course/grading/grade.h"

namespace dynlab::inline course {

/// Cached results of the runs of a script, independent of the checks: if only the checks change, the script does not
/// run again.
struct CachedRuns {
    std::string fingerprint;  ///< of the submission and of all that its runs depend on
    CheckedSubmission work;
    Message remark;  ///< see StagedWork
    std::string language;
};

std::optional<CachedRuns> read_cached_runs(const std::filesystem::path& file, const std::string& fingerprint);
/// Without the runs' times equal classes give equal files.
enum class CachedTimes { kNo, kYes };
void write_cached_runs(const std::filesystem::path& file, CachedRuns runs, CachedTimes times = CachedTimes::kNo);

/// Returns the result of `stage`: the one cached in `file` under this key, unless `again` is true; otherwise computes
/// and caches it.
CachedRuns cached(const std::filesystem::path& file, const std::string& key, bool again,
                  const std::function<CachedRuns()>& stage);

/// What an earlier run wrote into a submission's folder of results; nothing where there is none that can be read.
std::optional<Grade> earlier_grade(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
