#pragma once
#include <string>
#include <vector>

#include "course/anonymity/identity_matcher.h"

namespace dynlab::inline course {

/// Replaces names in answers that are read anonymously.
class HiddenNames {
  public:
    explicit HiddenNames(const std::vector<Student>& roster) : everybody_(roster) {}

    /// The text with every name, number, mail address and group of the roster as "[name]"; of its authors also what
    /// alone could mean another person: a given name, an initial.
    std::string hidden_in(std::string text, const std::vector<Student>& authors) const;

  private:
    IdentityMatcher everybody_;
};

}  // namespace dynlab::inline course
