#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/intake/owners.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// Whose file it is, by its name or its folder's (intake/owners.h), among the groups of a course.
class Senders {
  public:
    /// `numbers`: of participants by student, instead of those in the roster. Final versions are those of the group
    /// with which a student submitted first.
    Senders(Course& course, const Assignment& assignment, const std::string& stage,
            const std::map<std::string, std::string>& numbers);

    /// Whether the name is, or begins with, that of a group or a student: a zip of that name is theirs, not a class's.
    bool knows(const Submission& submission) const;
    /// Nothing when no group and no student fits, or several do.
    std::optional<Group> find(const Submission& submission) const;
    Message complaint(const Submission& submission) const;  ///< why find gave nothing, and what to do

  private:
    Owners::Found owner_of(const Submission& submission) const;

    std::vector<Group> groups_;
    std::vector<Student> students_;
    Owners owners_;
};

/// Moodle numbers participants for each assignment: the number is in the names of submissions and is kept with
/// the assignment, beside the one in the roster.

/// Within a transaction: keeps the number in the name that Moodle gave a sender of this group, for the member of that
/// name, or the only one. Names of other platforms have none.
void keep_participant(Course& course, std::int64_t assignment, const Submission& sender, const Group& group);

/// Numbers of students in this assignment, by id.
std::map<std::string, std::string> participants_of(Course& course, std::int64_t assignment);

}  // namespace dynlab::inline course
