#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "course/grading/work_item.h"

namespace dynlab::inline course {

/// What lateness costs once the instructor had a look. A penalty of half the points or more is more often a wrong time
/// (a file that was saved again, a wrong zone) than a late student: it counts only when it was accepted, or when the
/// instructor wrote the time of receipt into the table of deadlines. OUT/accepted_late.csv remembers what was accepted
/// (columns submission and percent).
class LatePenalties {
  public:
    /// `accept`: all penalties of this run are accepted. Throws EnvironmentError for a file that cannot be read.
    LatePenalties(std::filesystem::path out, bool accept);

    /// What is left of its lateness: the percentage is 0 while a penalty waits for the instructor, and the reason says
    /// so.
    Lateness counted(const std::string& submission, const Lateness& late);

    /// Of all that were counted: a clause for each late one, sorted by name.
    std::vector<Message> late() const;
    std::vector<Message> waiting() const;  ///< sentences: penalties that were not accepted
    Message doubt() const;                 ///< see doubt_about_zone
    /// Adds these to the work and remembers what was accepted.
    void conclude(ClassWork& work) const;

  private:
    struct Seen {
        Lateness lateness;
        bool waits = false;
    };
    std::filesystem::path file_;
    bool accept_;
    std::map<std::string, double> accepted_;  ///< percent by submission
    std::map<std::string, Seen> seen_;
};

}  // namespace dynlab::inline course
