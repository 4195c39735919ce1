#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/submission.h"

namespace dynlab::inline course {

/// What a student was known by before it was corrected.
struct FormerName {
    std::string name, mail;
};

struct Student {
    std::string id, name, group;
    std::optional<std::uint32_t> seed;        ///< the group's, where groups have records of their own
    std::string mail, moodle, canvas;         ///< address; numbers by which the learning platforms know the student
    std::vector<FormerName> former{};         ///< looked for in documents like what is known now
    std::vector<std::string> other_groups{};  ///< where they are or were besides; looked for like `group`
};

/// The students of a course. The file has a column `id`, and optionally `name`, `group`, `seed`, `email` (or `mail`),
/// `moodle` and `canvas`; others are not read.
class Roster {
  public:
    /// Throws EnvironmentError with file and line: no column id, an id that is empty or occurs twice,
    /// a seed that is not a whole number.
    explicit Roster(const std::filesystem::path& file);
    /// All columns are there.
    explicit Roster(std::vector<Student> students) : students_(std::move(students)) {}

    const std::vector<Student>& students() const { return students_; }
    bool has(const std::string& column) const;  ///< `mail` also for `email`
    /// Of the file, as its header has them, in lower case; empty without a file.
    const std::vector<std::string>& columns() const { return columns_; }
    std::vector<std::string> unknown_columns() const;
    /// Whose work it is, by the submission's own name (a group's, a student's id or name) or what an LMS wrote into it;
    /// never by what stands in the submission. What one member hands in is the whole group's. Places in students();
    /// empty when nobody fits.
    std::vector<std::size_t> owners(const Submission& submission) const;

  private:
    std::vector<Student> students_;
    std::vector<std::string> columns_;
};

}  // namespace dynlab::inline course
