#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_session.h"
#include "course/intake/issue.h"

namespace dynlab::inline course {

/// A file of checks.
struct CheckFile {
    std::string name, source;
    bool visible = true;  ///< students may read it
};

/// An answer that the checks see multiplied, every number of it: how sharp they look.
struct AnswerChange {
    std::string name;
    double factor = 1;
};

/// What is known of a submission when the checks are tried on it.
struct CheckedSubmission {
    std::map<std::string, GradedRun> runs;  ///< kMainRun, and one for each rerun
    Issues findings;                        ///< of `dynlab check`
    std::string source;                     ///< its script
    std::optional<AnswerChange> change;
};

/// Result of one check; only the description if the checks are listed.
struct EvaluatedCheck {
    CheckDescription check;
    std::optional<double> share;      ///< of the points; nothing for a check that could not be tried
    Message message, for_instructor;  ///< see CheckOutcome
    double seconds = 0;               ///< of processor time that it took
};

/// A submission to be checked, with the data sets of its group.
struct SubmissionToGrade {
    CheckedSubmission work;
    std::filesystem::path home;                     ///< DYNLAB_HOME during the checks
    std::map<std::string, PlantVariants> variants;  ///< see CheckSession
};

/// Check results of one submission.
struct GradedSubmission {
    std::vector<EvaluatedCheck> checks;
    Message reason;  ///< why there are none: "it used more than 60 s of processor time", "it crashed (signal 11)", ...
    double seconds = 0;  ///< wall clock
};

struct CheckResults {
    std::vector<EvaluatedCheck> checks;    ///< as they are declared
    std::vector<GradedSubmission> judged;  ///< one entry per submission of ChecksJob::submissions, in order
    std::vector<std::string> plants;       ///< data sets of the simulated plants that the files declare
    std::vector<std::map<std::string, std::vector<double>>> data_sets;  ///< one entry per request of the job, in order
    std::optional<Message> error;  ///< a sentence, when a file cannot be read; then there is nothing else
};

/// A request for a data set of a simulated plant that the files declare.
struct RequestedDataSet {
    std::string plant;
    std::uint32_t variant = 0, seed = 1;
};

/// Job: check files, and the submissions to be checked.
struct ChecksJob {
    static constexpr char kWork[] = "checks";
    using Result = CheckResults;

    std::vector<CheckFile> files;
    std::filesystem::path hidden_folder;         ///< holds NAME.mat or NAME.csv
    std::int64_t time_ms = 0;                    ///< most milliseconds of processor time for each check
    std::int64_t most_ms = 0;                    ///< for each submission
    int clock_multiple = 0;                      ///< the clock's limits, see TimeLimits
    std::optional<std::size_t> only;             ///< the number of the one that is wanted; nothing for all
    std::vector<SubmissionToGrade> submissions;  ///< none to list the checks only
    std::vector<RequestedDataSet> data_sets;
};

/// Reads the check files and runs the checks in this process, which must be in a sandbox. Each submission is checked in
/// a separate confined child process, so that it can neither read nor change the answers of another one. Without
/// submissions, this process itself is confined.
CheckResults try_checks(const ChecksJob& job);

}  // namespace dynlab::inline course
