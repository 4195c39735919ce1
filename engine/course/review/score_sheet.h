#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// Reads a table of scores, whole or not at all, and returns how many scores and comments are new. Every table has
/// columns of criteria; an empty cell changes nothing, and "-" takes a score back. Of a report at the stage "first":
/// reviewer (a group) and report (report-NN; may be missing where the group has one), where the reviewer "instructor"
/// is the instructor, and the report a pseudonym or a group. At the stage "final": group. Of a talk: group, student (an
/// id, or a name that one student has) or both, and comment; a row without a student is of the whole group. Points for
/// a group that dropped out or submitted nothing, or of a withdrawn review, are refused. Throws InvalidArgument for a
/// lab, EnvironmentError with file, line and column.
int import_scores(Course& course, const Assignment& assignment, const std::string& stage,
                  const std::filesystem::path& file, Instant now);

/// Takes back all scores of one review, or with the reviewer "instructor" the instructor's own of the report. Throws
/// InvalidArgument for an empty reason, and where there are none.
void drop_scores(Course& course, const Assignment& assignment, const std::string& reviewer, const std::string& report,
                 const std::string& reason, Instant now);

struct OralSheetOptions {
    bool students = false;  ///< a row a student as well, below the group's
    bool drawn = false;  ///< in a random order, the same one each time, that only the course's key gives; else by name
};
/// The sheet for the oral: a row a group, a column a criterion with what was given so far, and one for comments, as
/// CSV. Throws InvalidArgument for a report or a lab.
std::string oral_sheet(Course& course, const Assignment& assignment, const OralSheetOptions& options = {});

/// The newest comment on a group at the oral, and on each of its members.
struct OralComments {
    std::map<std::int64_t, std::string> groups;
    std::map<std::string, std::string> students;  ///< by their ids
};
OralComments oral_comments(Course& course, const Assignment& assignment);

}  // namespace dynlab::inline course
