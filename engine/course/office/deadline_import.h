#pragma once
#include <filesystem>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

struct DeadlineImport {
    int extended = 0, corrected = 0;
    std::vector<Message> complaints;  ///< sentences: rows that could not be taken
};

/// Takes a table of deadlines as dynlab grade reads it (grading/deadlines.h) into the course: the row of * becomes
/// deadline, grace and penalty of the assignment, other rows extensions of groups and times of receipt. Times are in
/// the course's time zone. A row that says what the course has already changes nothing. Throws as Deadlines does.
DeadlineImport import_deadlines(Course& course, const Assignment& assignment, const std::filesystem::path& file,
                                Instant now);

}  // namespace dynlab::inline course
