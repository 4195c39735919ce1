#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/checks/check_session.h"
#include "course/findings/finding.h"

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
    std::map<std::string, GradedRun> runs;  ///< "main", and one for each rerun
    Findings findings;                      ///< of `dynlab check`
    std::string source;                     ///< its script
    std::optional<AnswerChange> change;
};

/// What one check says; nothing but its description when the checks are only listed.
struct TriedCheck {
    CheckDescription check;
    std::optional<double> share;          ///< of the points; nothing for a check that could not be tried
    std::string message, for_instructor;  ///< see Verdict
    double seconds = 0;                   ///< that it took
};

struct CheckResults {
    std::vector<TriedCheck> checks;
    std::vector<std::vector<TriedCheck>> further;                     ///< of ChecksJob::further, one by one
    std::vector<std::string> rigs;                                    ///< data sets of the rigs that the files declare
    std::vector<std::map<std::string, std::vector<double>>> records;  ///< of ChecksJob::records, one by one
    std::optional<std::string> error;  ///< a sentence, when a file cannot be read; then there is nothing else
};

/// A record to be made by a rig that the files declare.
struct WantedRecord {
    std::string rig;
    std::uint32_t specimen = 0, seed = 1;
};

/// Check files to be tried on a submission, or to be listed.
struct ChecksJob {
    static constexpr char kWork[] = "checks";
    using Result = CheckResults;

    std::vector<CheckFile> files;
    std::filesystem::path hidden_folder;  ///< holds NAME.mat or NAME.csv
    std::map<std::string, Specimens> specimens;
    std::int64_t time_ms = 0;                     ///< most milliseconds for each check
    std::optional<std::size_t> only;              ///< the number of the one that is wanted; nothing for all
    std::optional<CheckedSubmission> submission;  ///< nothing to list the checks only
    std::vector<CheckedSubmission> further;       ///< tried after it, with the same files read once
    std::vector<WantedRecord> records;
};

/// Reads the files and tries their checks, in this process, which should be in a box and is confined here.
CheckResults try_checks(const ChecksJob& job);

}  // namespace dynlab::inline course
