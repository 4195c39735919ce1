#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/intake/course_clock.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

/// The times when submissions were received, from the learning platform's table: Moodle's grading worksheet ("Last
/// modified (submission)", in several languages), or any CSV with a column id, identifier, group, name, mail or email,
/// and a column time or received. A student without a row, or with the time "-", has no time.
class ArrivalTimes {
  public:
    ArrivalTimes() = default;
    /// Times without a zone are in the process's. Throws EnvironmentError with file, line and column.
    explicit ArrivalTimes(const std::filesystem::path& csv);

    /// By the number that the platform wrote into the name, the person or the group of the name, or one of these other
    /// names.
    std::optional<Instant> of(const Submission& submission, const std::vector<std::string>& also = {}) const;

  private:
    std::map<std::string, Instant> times_;  ///< by identifier in lower-case letters
};

/// The file's own time, as archives keep it; nothing where it is of before 2000: what packs and some programs write
/// instead of one.
std::optional<Instant> time_in_archive(const std::filesystem::path& file);

/// A sentence that asks whether the zone is right, where all or nearly all files are late by less than what zones
/// differ; else empty. `late`: seconds of the late ones among `files`.
Message doubt_about_zone(std::vector<std::int64_t> late, std::size_t files);

}  // namespace dynlab::inline course
