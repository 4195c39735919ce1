#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "course/checks/check_run.h"
#include "course/grading/grade.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

struct GradingRequest;

/// SHA-256 of all that was handed in, names and contents. Of what is too large to be graded its size alone: reading it
/// may take for ever. Throws what the file system does where something cannot be looked into.
std::string hash_of_content(const Submission& submission);

/// What an earlier run wrote into a submission's folder of results; nothing where there is none that can be read.
std::optional<Grade> earlier_grade(const std::filesystem::path& folder);

/// Throws EnvironmentError where the results in request.out are those of another lesson. Makes the folder.
void refuse_other_lessons(const GradingRequest& request);

/// Writes what the results in request.out are made with: it stands beside them as grading.json, so that no later run
/// mixes marks of two kinds. Throws EnvironmentError that tells the differences where those that are there were made
/// with something else and are not to be made again. A roster or a list of owners, which say whose work it is, may be
/// given or mended when all of the class is graded, as the gradebook is then made anew from all of it; one that is
/// missing now counts. Deadlines take points: other ones always count.
void remember_inputs(const GradingRequest& request);

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

}  // namespace dynlab::inline course
