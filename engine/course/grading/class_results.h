#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grading_rules.h"
#include "course/grading/work_item.h"
#include "course/sandbox_jobs/sandboxed_document.h"

namespace dynlab::inline course {

/// A class and its marks, after one run of grade.
struct ClassResults {
    struct Entry {
        const WorkItem* item = nullptr;
        std::optional<Grade> grade;  ///< nothing: not graded yet
    };
    std::vector<Entry> entries;      ///< as work->items
    std::vector<CountedMark> marks;  ///< as work->students
    const ClassWork* work = nullptr;
    std::filesystem::path out;
    const GradingSetup* setup = nullptr;
    bool pdf = true;
    const SandboxedDocuments* documents = nullptr;
    std::vector<Message> complaints;
};

/// What needs the instructor's attention.
struct Attention {
    std::vector<Message> sentences;           ///< ""group-5" cannot be read: It is empty."
    std::size_t unowned = 0, unreadable = 0;  ///< of those
};
Attention what_needs_attention(const ClassResults& results);

/// For each entry, the name of the entry that counts instead for its owners; empty if the entry itself counts.
std::vector<std::string> counted_instead(const ClassResults& results);

/// Writes gradebook.csv (a row for each student of the roster, or each submission if there is no roster) and the
/// summary (report_templates/class_summary.md, set in a sandbox): numbers, histogram, success of each check,
/// submissions that need attention. Missing marks by hand get rows in marks.csv (manual_marks.h); summary.json has the
/// numbers for programs (grading/class_statistics.h). If LaTeX cannot set the summary, writes it as Markdown and
/// returns a note that says why: the marks of a class do not depend on it.
std::optional<Message> write_class_results(const ClassResults& results, const Attention& attention);

}  // namespace dynlab::inline course
