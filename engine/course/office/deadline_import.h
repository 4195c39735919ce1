#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// A row of a table of deadlines; what it leaves empty is as in the row of *; there: no grace, 10 and 100
/// percent. In a table without that row it is as in the assignment.
struct DeadlineRow {
    Instant deadline = 0;
    std::optional<Instant> received;  ///< when it was received, if not by the time that the course has
    std::int64_t grace = 0;
    double percent_per_day = 10, max_percent = 100;
};
/// By the names in the column `submission`, `who`, `group`, `id`, `student` or `name`; * is the row of all. Further
/// columns: `deadline` (2026-03-01 18:00, seconds optional), and optionally `extra` (time beyond the deadline of all:
/// "2 d", "3 h"), `received`, `grace` ("15 min"), `percent_per_day` (part of a day counts as a day) and `most_percent`.
/// Times are in the process's time zone. Throws EnvironmentError with file, line and column.
std::map<std::string, DeadlineRow> read_deadlines(const std::filesystem::path& file, const DeadlineRow& defaults = {});

struct DeadlineImport {
    int extended = 0, corrected = 0;
    std::vector<Message> complaints;  ///< sentences: rows that could not be taken
};

/// Takes such a table into the course: the row of * becomes deadline, grace and penalty of the assignment, other rows
/// extensions of groups; the times in `received` are corrections. A row names a group, a student in any spelling, or
/// one of `submissions` (the ids of groups by names). Of several rows of a group the one with the latest deadline
/// counts. A row that says what the course has already changes nothing. Throws as read_deadlines.
DeadlineImport import_deadlines(Course& course, const Assignment& assignment, const std::filesystem::path& file,
                                Instant now, const std::map<std::string, std::int64_t>& submissions = {});

}  // namespace dynlab::inline course
