#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// A platform's table with marks of the course.
struct FilledWorksheet {
    std::string text;
    std::size_t marks = 0;            ///< that were written
    std::vector<Message> complaints;  ///< sentences: rows of nobody, and students with a mark but without a row
};

/// Writes the percent of an assignment, or without one the total of the course, times the most points of the column of
/// grades (100 where the table does not tell), into Moodle's grading worksheet or Canvas's gradebook. Everything else
/// in it stays. `column`: of Canvas's gradebook, where it has several. Throws EnvironmentError as PlatformSheet.
FilledWorksheet fill_worksheet(Course& course, const std::optional<Assignment>& assignment,
                               const std::filesystem::path& worksheet, const std::string& column, Instant now);

}  // namespace dynlab::inline course
