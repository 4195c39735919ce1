#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "course/intake/course_clock.h"
#include "course/store/incoming.h"

namespace dynlab::inline course {

/// When files were handed in, as the learning platform's table tells: Moodle's grading worksheet (columns Identifier
/// and "Last modified (submission)"), or any CSV with a column id, identifier, group, name, mail or email, and one time
/// or received. Who is not in it, or has no time there ("-"), has none.
class ArrivalTimes {
  public:
    /// Times without a zone are in the clock's. Throws EnvironmentError with file, line and column.
    ArrivalTimes(const std::filesystem::path& csv, const CourseClock& clock);

    /// By the number that the platform wrote into the folder's name, the person or the group of its name.
    std::optional<Instant> of(const IncomingFile& file) const;

  private:
    std::map<std::string, Instant> times_;  ///< by identifier in lower-case letters
};

/// The file's own time, as archives keep it; nothing where it is of before 2000: what packs and some programs write
/// instead of one.
std::optional<Instant> time_in_archive(const IncomingFile& file);

}  // namespace dynlab::inline course
