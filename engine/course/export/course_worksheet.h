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
    std::vector<Message> complaints;  ///< sentences: unmatched rows, and students with a mark but without a row
};

/// Writes the marks of an assignment, or of the whole course if none is given, into Moodle's grading worksheet or
/// Canvas's gradebook. They are scaled to the maximum points of the grade column; if the table states none, a lab has
/// its points and all else its percentage. All other content of the file stays unchanged. `column`: the column of
/// Canvas's gradebook, if it has several. Throws EnvironmentError as PlatformSheet does.
FilledWorksheet fill_worksheet(Course& course, const std::optional<Assignment>& assignment,
                               const std::filesystem::path& worksheet, const std::string& column, Instant now);

}  // namespace dynlab::inline course
