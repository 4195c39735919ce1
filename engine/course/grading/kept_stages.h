#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_run.h"
#include "course/grading/grade.h"

namespace dynlab::inline course {

/// What a script did when it was run, kept apart from what the checks say of it: with other checks it need not run
/// again.
struct KeptRuns {
    std::string fingerprint;  ///< of the submission and of all that its runs depend on
    CheckedSubmission work;
    Message remark;  ///< see StagedWork
    std::string language;
};

std::optional<KeptRuns> read_kept_runs(const std::filesystem::path& file, const std::string& fingerprint);
/// Without the runs' times equal classes give equal files.
enum class KeptTimes { kNo, kYes };
void write_kept_runs(const std::filesystem::path& file, KeptRuns runs, KeptTimes times = KeptTimes::kNo);

/// What `stage` gives: as an earlier run kept it in `file` under this key, unless `again`; else made now, and kept.
KeptRuns cached(const std::filesystem::path& file, const std::string& key, bool again,
                const std::function<KeptRuns()>& stage);

/// What an earlier run wrote into a submission's folder of results; nothing where there is none that can be read.
std::optional<Grade> earlier_grade(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
