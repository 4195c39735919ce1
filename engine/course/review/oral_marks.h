#pragma once
#include <map>
#include <string>

#include "course/review/review_marks.h"
#include "course/review/score_sheet.h"

namespace dynlab::inline course {

/// What was said of a group at the oral, and of each of its members.
struct OralComments {
    std::map<std::int64_t, std::string> groups;
    std::map<std::string, std::string> students;  ///< by their ids
};

/// Reads a filled sheet, whole or not at all. Columns: group, or student (an id, or a name that one student has), or
/// both; the criteria; comment. A row without a student is of the whole group. What a student has no points for has the
/// group's; "-" takes points back that were given before. Empty cells change nothing. Points for a group that dropped
/// out are refused. Returns how many scores and comments are new. Throws EnvironmentError with file, line and column.
int import_oral_scores(Course& course, const Assignment& assignment, const std::filesystem::path& file, Instant now);

struct OralSheetWishes {
    bool students = false;  ///< a row a student as well, below the group's
    bool drawn = false;  ///< in a random order, the same one each time, that only the course's key gives; else by name
};
/// The sheet for the oral: a row a group, a column a criterion with what was given so far, and one for comments, as
/// CSV. Throws InvalidArgument for a report.
std::string oral_sheet(Course& course, const Assignment& assignment, const OralSheetWishes& wishes = {});

std::map<std::int64_t, CriterionPoints> oral_points(Course& course, const Assignment& assignment);  ///< by group
OralComments oral_comments(Course& course, const Assignment& assignment);                           ///< the newest

/// The criteria for which any group or student has points: an empty cell of another one that has points counts 0 there.
std::vector<bool> graded_criteria(Course& course, const Assignment& assignment);
/// Sets the missing points of graded criteria to 0 and names these criteria.
void count_missing_points(const Assignment& assignment, const std::vector<bool>& graded, CriterionPoints& points,
                          std::vector<std::string>& zeros);
bool has_points(const CriterionPoints& points);  ///< for any criterion

/// Puts the marks of those members in who have points of their own. What `mark.work_costs` takes off the group's comes
/// off theirs, too.
void add_student_marks(Course& course, const Assignment& assignment, std::vector<GroupMark>& marks);

}  // namespace dynlab::inline course
