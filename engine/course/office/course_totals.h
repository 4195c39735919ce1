#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/marks.h"

namespace dynlab::inline course {

/// What a student has for one assignment.
struct AssignmentMark {
    std::optional<double> percent;    ///< nothing: not marked yet, or not due
    bool missing = false;             ///< nothing was submitted, though it was due: 0 percent
    bool open = false;                ///< submitted and not marked yet
    std::optional<LabMark> lab = {};  ///< of a lab that was submitted or marked; also where it is missing
};

/// By student, by id. The work of the group that the student belonged to when it submitted counts; marks of single
/// students go before those of their groups. A report's percent has that of its reviews in it, by reviews_weight.
/// `versions`: see lab_marks.
std::map<std::string, AssignmentMark> marks_of_students(Course& course, const Assignment& assignment, Instant now,
                                                        const std::set<std::int64_t>* versions = nullptr);

/// The mean of the percent of assignments by their weights; nothing where none counts. `marks` in the order of
/// `assignments`.
std::optional<double> weighted_total(const std::vector<Assignment>& assignments,
                                     const std::vector<AssignmentMark>& marks);

/// Adds an entry to the history: marks were written into `file`, those of the course if `assignment` is empty. The
/// entry includes the totals if there are any, so that changed_since_export can report changes.
void note_export(Course& course, const std::string& assignment, const std::string& file, const std::string& totals,
                 Instant now);

/// A cell of totals_csv that is not as it was exported last.
struct ChangedCell {
    std::string student, name, column, before, now;
};
struct ExportChanges {
    std::optional<Instant> exported;  ///< nothing: the totals have never been exported
    std::vector<ChangedCell> cells;
};
ExportChanges changed_since_export(Course& course, const std::string& totals);

/// The marks of all students for all assignments.
struct CourseTotals {
    std::vector<Assignment> assignments;
    std::vector<Student> students;
    std::vector<std::vector<AssignmentMark>> marks;  ///< by student, then by assignment
};
CourseTotals course_totals(Course& course, Instant now);

/// A row a student: identifiers, group, the percent of each assignment, the total, and what is not marked yet. CSV with
/// formulas neutralized.
std::string totals_csv(const CourseTotals& totals);

}  // namespace dynlab::inline course
