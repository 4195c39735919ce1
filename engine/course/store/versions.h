#pragma once
#include <optional>
#include <string>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// A file that becomes the next version of a part.
struct NewVersion {
    std::int64_t group = 0;
    std::string group_name, stage = "first", part;
    std::optional<std::int64_t> pair;  ///< of a review
    std::int64_t number = 1;
    std::string hash, name;  ///< of the file, which the course keeps already
    std::int64_t bytes = 0;
    Instant at = 0;        ///< when it was received
    std::string findings;  ///< see Inspection
};
struct AddedVersion {
    std::int64_t id = 0;
    std::int64_t late = 0;  ///< seconds, as its receipt says
};

/// Within a transaction: enters a version with its deadline, lateness and signature. `now`: when the file was stored.
AddedVersion add_version(Course& course, const Assignment& assignment, const NewVersion& version, Instant now);

}  // namespace dynlab::inline course
