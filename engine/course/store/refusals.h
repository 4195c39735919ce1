#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"

namespace dynlab::inline course {

/// A file that was submitted and not taken. It stays in the store, so that nobody has to say that it never came.
struct RefusedFile {
    std::optional<std::int64_t> group;  ///< nothing where the sender is not known
    std::string stage = "first", name;
    std::string hash;    ///< under which the course keeps it; empty where it could not be kept
    std::string reason;  ///< a clause, as the instructor read it
    Instant at = 0;
};

/// Before a transaction: keeps the content of a file; returns its hash, or nothing for an empty or too large one.
std::string kept_content(const Course& course, const std::filesystem::path& file, std::uintmax_t most_bytes);

/// Within a transaction: leaves a trace of a file. The same file of the same sender, refused for the same reason, is
/// noted once.
void record_refused(Course& course, const Assignment& assignment, const RefusedFile& file);

/// In the order in which they came; with `open_only` those that were not taken later, and after which the group has
/// submitted nothing that was taken.
std::vector<RefusedFile> refused_files(Course& course, const Assignment& assignment, bool open_only = false);

}  // namespace dynlab::inline course
