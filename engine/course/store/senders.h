#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/store/groups.h"

namespace dynlab::inline course {

/// Whose file it is, by its name or its folder's and never by what stands in it.
class Senders {
  public:
    explicit Senders(Course& course);

    bool knows(const Submission& submission) const { return find(submission).has_value(); }
    /// Nothing when no group and no student fits, or several do.
    std::optional<Group> find(const Submission& submission) const;
    std::string complaint(const Submission& submission) const;  ///< why find gave nothing, and what to do

  private:
    std::optional<Group> group_called(const std::string& name) const;
    std::optional<Group> group_that_begins(const std::string& name) const;

    std::vector<Group> groups_;
    Roster roster_;
};

}  // namespace dynlab::inline course
