#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/message.h"
#include "course/intake/roster.h"
#include "course/store/course_store.h"

namespace dynlab::inline course {

/// Students who submit together: one or several.
struct Group {
    std::int64_t id = 0;
    std::string name;
    bool dropped_out = false;          ///< dropped out
    std::vector<std::string> members;  ///< ids of the students who belong to it now
};

/// Groups sorted by name: groups with members, work or marks. Empty groups of an earlier roster are omitted.
std::vector<Group> groups_of(Course& course);
/// The one that `name` means: by its own name in any spelling ("group-08", "Group 8"), or by the name, id or address of
/// a member, or of a platform's number for one. Throws InvalidArgument with the nearest name where no group is meant,
/// or several are.
Group group_named(Course& course, const std::string& name);
/// The student called so: by id, name or address. Throws InvalidArgument like group_named.
Student student_named(Course& course, const std::string& name);

/// Ids of those who belonged to a group at an instant, sorted. The first group of a student counts from the beginning,
/// as a roster is often read after the first work came; later changes count from the moment they were entered.
std::vector<std::string> members_at(Course& course, std::int64_t group, Instant at);

/// All who ever were in the course, with the names and addresses that they had before; `group` is the one each belongs
/// to now (the first by name where there are several).
std::vector<Student> students_of(Course& course);

struct RosterChange {
    struct Move {
        std::string student, from, to;  ///< id; names of groups, joined by |
    };
    int students = 0, new_students = 0, changed = 0, new_groups = 0;
    std::vector<Move> moved;
    std::vector<std::string> absent;           ///< ids of students who are not in the file; they stay
    std::vector<std::string> unknown_columns;  ///< that were not read
    Message short_ids;                         ///< a sentence about ids that are too short to search for
    bool converted = false;                    ///< see TextTable
};
/// Imports a roster (columns id and group, and optionally name, email or mail, moodle, canvas) into the course,
/// completely or not at all. Fields without a column stay unchanged; former names and addresses stay known. A student
/// without a group forms a group alone; a student in several groups has them joined by "|". A student with a new group
/// leaves the former one; both stay known, so that no student reviews work of a former group. With `no_groups` the
/// column group may be missing: a new student then forms a group alone. Otherwise a missing column throws
/// EnvironmentError. `now`: from when the memberships count.
RosterChange import_roster(Course& course, const std::filesystem::path& file, bool no_groups = false,
                           Instant now = CourseClock::now());

/// The group has dropped out, or is back. Its work stays. Throws InvalidArgument where that was so before.
void set_group_dropped_out(Course& course, const std::string& name, bool dropped_out, const std::string& reason);

/// Pairs of groups who share a member, or did at any time.
std::vector<std::pair<std::int64_t, std::int64_t>> kindred_groups(Course& course);

}  // namespace dynlab::inline course
