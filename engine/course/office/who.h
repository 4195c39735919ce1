#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "course/corrections/corrections.h"
#include "course/office/course_totals.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// A version that one of the person's groups submitted.
struct WhoVersion {
    std::string group, stage, part, name, hash;
    std::int64_t id = 0, number = 0, late = 0;  ///< id: the number of its receipt
    Instant received = 0;
    bool withdrawn = false;
    Message error_reason;  ///< why it cannot be read; else empty
};
struct WhoExtension {
    std::string stage;
    std::optional<Instant> due;  ///< nothing: as for all
    std::string reason;
};
/// The submissions and marks of a person and the person's groups for one assignment.
struct WhoWork {
    Assignment assignment;
    std::vector<WhoVersion> versions;
    std::vector<WhoExtension> extensions;
    std::vector<std::pair<std::string, AssignmentMark>> marks;  ///< by the names of the people
};
struct WhoMember {
    std::string name;
    std::optional<Instant> until;
};
struct WhoGroup {
    std::string name;
    std::vector<WhoMember> members;  ///< now and before
};

/// All that the course knows of one student and the groups the student was in, or of one group.
struct WhoFacts {
    std::vector<Student> people;
    std::vector<WhoGroup> groups;
    std::vector<WhoWork> work;
    std::vector<JournalLine> history;
};
/// `name` as group_named takes it, or a student's. Throws InvalidArgument.
WhoFacts who_is(Course& course, const std::string& name, Instant now);

/// The same as text: members now and before, every version with its receipt, extensions, marks, and the lines of the
/// history that name them.
std::string who_text(Course& course, const std::string& name, Instant now);

}  // namespace dynlab::inline course
