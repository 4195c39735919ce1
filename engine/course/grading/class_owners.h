#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grade.h"
#include "course/grading/grading.h"
#include "course/intake/owners.h"
#include "course/intake/roster.h"

namespace dynlab::inline course {

/// Whose the submissions of a class are, as far as a roster and a list of owners tell; nobody's without a roster.
class ClassOwners {
  public:
    /// Throws EnvironmentError: a list without a roster, files that cannot be read.
    explicit ClassOwners(const GradingRequest& request);
    ClassOwners(const ClassOwners&) = delete;  // owners know the roster by its place
    ClassOwners& operator=(const ClassOwners&) = delete;

    const Roster* roster() const { return roster_ ? &*roster_ : nullptr; }
    Owners::Found of(const Submission& submission) const;
    /// By what else than its own name it is known.
    std::vector<std::string> names_of(const Submission& submission) const;
    std::vector<std::string> all_names() const;  ///< of all students
    /// Places of those that words mean, by a submission's name or number, or by its owner's group, id or name; of all
    /// without a word. Throws EnvironmentError for a word that means none.
    std::vector<std::size_t> chosen(const std::vector<Submission>& submissions,
                                    const std::vector<std::string>& words) const;
    std::optional<std::uint32_t> seed_of(const Submission& submission) const;  ///< of the group's own records
    /// Whom the feedback is for, and in which language.
    void address(const Submission& submission, Grade& grade) const;
    std::vector<std::string> strays(const std::vector<Submission>& submissions) const;  ///< see Owners::strays

  private:
    bool is_meant(const Submission& submission, const std::string& word) const;
    std::optional<Roster> roster_;
    std::optional<Owners> owners_;
};

}  // namespace dynlab::inline course
