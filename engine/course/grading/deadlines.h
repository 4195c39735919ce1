#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/submission.h"

namespace dynlab::inline course {

/// What lateness costs. The table has the columns `submission` (a name, an LMS number, or * for all), `deadline`
/// (2026-03-01 18:00, local time, seconds optional), and optionally `received` (when it was received, if not by the
/// archive's own time), `percent_per_day` (10 unless given; begun days count) and `most_percent` (100 unless given).
class Deadlines {
  public:
    Deadlines() = default;
    /// Throws EnvironmentError with file, line and column.
    explicit Deadlines(const std::filesystem::path& file);

    struct Lateness {
        double hours = 0, percent = 0;  ///< of the points earned
    };
    Lateness of(const Submission& submission) const;
    /// The names in the table that are those of none of the submissions.
    std::vector<std::string> strays(const std::vector<Submission>& submissions) const;

  private:
    struct Rule {
        long deadline = 0;
        std::optional<long> received;
        double percent_per_day = 10, most_percent = 100;
    };
    std::map<std::string, Rule> rules_;
};

}  // namespace dynlab::inline course
