#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/boxed_document.h"
#include "course/grading/grading_rules.h"
#include "course/grading/roster.h"
#include "course/grading/submission.h"

namespace dynlab::inline course {

/// A class and its marks, after one run of grade.
struct ClassResults {
    struct Entry {
        Submission submission;
        std::optional<Grade> grade;  ///< nothing: not graded yet
    };
    std::vector<Entry> entries;
    const Roster* roster = nullptr;
    std::filesystem::path out;
    const GradingSetup* setup = nullptr;
    bool pdf = true;
    const BoxedDocuments* documents = nullptr;
    std::vector<std::string> complaints;
};

/// Writes gradebook.csv (a row for each student of the roster, or each submission where there is none) and the summary
/// (report_templates/class_summary.md, set in a box): numbers, histogram, success of each check, what needs the
/// instructor's eye. by_hand.csv is the table of what is to be marked by hand yet, where there is any.
void write_class_results(const ClassResults& results);

}  // namespace dynlab::inline course
