#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/intake/owners.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// Whose file it is, by its name or its folder's (intake/owners.h), among the groups of a course.
class Senders {
  public:
    explicit Senders(Course& course);

    /// Whether the name is, or begins with, that of a group or a student: a zip of that name is theirs, not a class's.
    bool knows(const Submission& submission) const;
    /// Nothing when no group and no student fits, or several do.
    std::optional<Group> find(const Submission& submission) const;
    Message complaint(const Submission& submission) const;  ///< why find gave nothing, and what to do

  private:
    std::vector<Group> groups_;
    std::vector<Student> students_;
    Owners owners_;
};

}  // namespace dynlab::inline course
