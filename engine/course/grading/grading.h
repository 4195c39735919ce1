#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grading_rules.h"

namespace dynlab::inline course {

struct GradingRequest {
    GradingSetup setup;
    std::filesystem::path submissions, out;
    std::optional<std::filesystem::path> roster, deadlines;
    std::vector<std::string> only;  ///< names of submissions; all when empty
    bool regrade = false;           ///< also those that have a result already
    bool pdf = true;                ///< feedback and summary as PDF, besides Markdown
};

struct GradingOutcome {
    int submissions = 0, made = 0, kept = 0, not_whole = 0;  ///< not_whole: a check is left ungraded
    std::vector<std::string> complaints;                     ///< whole sentences for the instructor
};

/// Grades a class. In `out`: results/NAME/ with results.json and feedback.md and .pdf for each submission,
/// logs/NAME/log.txt, which may quote hidden records, gradebook.csv, summary.md or .pdf, manual.csv. Each submission is
/// graded alone, in boxes; a result whose inputs are unchanged is kept, so that a run that was ended goes on where it
/// was. Marks depend on neither the order nor `setup.jobs`. Throws EnvironmentError for what must be mended first,
/// Interrupted after Ctrl-C.
GradingOutcome grade_class(const GradingRequest& request);

}  // namespace dynlab::inline course
