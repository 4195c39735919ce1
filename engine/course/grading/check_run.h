#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/findings/finding.h"
#include "course/grading/check_session.h"

namespace dynlab::inline course {

/// A file of checks.
struct CheckFile {
    std::string name, source;
    bool visible = true;  ///< students may read it
};

/// What is known of a submission when the checks are tried on it.
struct CheckedSubmission {
    std::map<std::string, GradedRun> runs;  ///< "main", and one for each rerun
    Findings findings;                      ///< of `dynlab check`
};

/// What one check says; nothing but its description when the checks are only listed.
struct TriedCheck {
    CheckDescription check;
    std::optional<double> share;          ///< of the points; nothing for a check that could not be tried
    std::string message, for_instructor;  ///< see Verdict
};

struct CheckResults {
    std::vector<TriedCheck> checks;
    std::optional<std::string> error;  ///< a sentence, when a file cannot be read; then there is nothing else
};

/// Check files to be tried on a submission, or to be listed.
struct ChecksJob {
    static constexpr char kWork[] = "checks";
    using Result = CheckResults;

    std::vector<CheckFile> files;
    std::filesystem::path hidden_folder;  ///< holds NAME.mat
    std::map<std::string, Specimens> specimens;
    std::int64_t time_ms = 0;                     ///< most milliseconds for each check
    std::optional<std::size_t> only;              ///< the number of the one that is wanted; nothing for all
    std::optional<CheckedSubmission> submission;  ///< nothing to list the checks only
};

/// Reads the files and tries their checks, in this process, which should be in a box and is confined here.
CheckResults try_checks(const ChecksJob& job);

}  // namespace dynlab::inline course
