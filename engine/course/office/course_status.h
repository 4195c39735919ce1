#pragma once
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/newest_versions.h"

namespace dynlab::inline course {

/// What the instructor may want to do about a group.
struct ToDo {
    std::string kind;   ///< "missing", "missing-script", "unreadable", "no-pdf", "same-file", "kin", "held", "stopped",
                        ///< "newer-report", "newer-review", "unassigned" or "dropped"
    std::string stage;  ///< "first", "review" or "final"
    std::string about;  ///< why a file cannot be read, a report's pseudonym, a number of reviews; may be empty
    std::string text;   ///< as the terminal shows it
};

/// What a group submitted for an assignment, and what to do about it.
struct GroupState {
    Group group;
    SubmittedParts first, last;
    std::vector<ToDo> to_do;
};

/// The state of an assignment. Groups that dropped out and submitted nothing are left out.
struct AssignmentState {
    std::vector<GroupState> groups;
    int present = 0, late = 0, unreadable = 0, missing = 0;  ///< groups with a first version, ...
    std::string next;                                        ///< the next command; may be empty
};
AssignmentState assignment_state(Course& course, const Assignment& assignment, Instant now);

/// The state of an assignment as a table for the instructor: deadlines, a row for each group with its submissions, late
/// and unreadable files and the required action, sums, and the next command.
std::string assignment_status(Course& course, const Assignment& assignment, Instant now);

/// The course at a glance: groups, assignments and their deadlines.
std::string course_summary(Course& course, Instant now);

}  // namespace dynlab::inline course
