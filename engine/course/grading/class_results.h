#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/boxes/boxed_document.h"
#include "course/grading/grading_rules.h"
#include "course/intake/owners.h"
#include "course/intake/roster.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

/// A class and its marks, after one run of grade.
struct ClassResults {
    struct Entry {
        Submission submission;
        std::optional<Grade> grade;  ///< nothing: not graded yet
        Owners::Found owner;         ///< where there is a roster
        std::int64_t received = 0;   ///< seconds since 1970
        std::string content = {};    ///< hash of what was handed in; empty for what was not looked at
    };
    std::vector<Entry> entries;
    const Roster* roster = nullptr;
    std::filesystem::path out;
    const GradingSetup* setup = nullptr;
    bool pdf = true;
    const BoxedDocuments* documents = nullptr;
    std::vector<Message> complaints;
    bool deadlines = false;      ///< there are some: the gradebook tells the reason of each penalty
    bool newest_counts = false;  ///< of several hand-ins of one student; else the better one
};

/// What the instructor must look at.
struct NeedsTheEye {
    std::vector<Message> sentences;           ///< one a submission: ""group-5" cannot be read: It is empty."
    std::size_t unowned = 0, unreadable = 0;  ///< of those
};
NeedsTheEye what_needs_the_eye(const ClassResults& results);

/// For each entry the name of the one that counts in place of it, for each of its owners; empty where it counts itself.
std::vector<std::string> counted_instead(const ClassResults& results);

/// Writes gradebook.csv (a row for each student of the roster, or each submission where there is none) and the summary
/// (report_templates/class_summary.md, set in a box): numbers, histogram, success of each check, what needs the
/// instructor's eye. by_hand.csv is the table of what is to be marked by hand yet, where there is any, summary.json the
/// numbers for programs (grading/class_statistics.h).
void write_class_results(const ClassResults& results);

}  // namespace dynlab::inline course
