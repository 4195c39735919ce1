#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// What a student was known by before it was corrected.
struct FormerName {
    std::string name, mail;
};

struct Student {
    std::string id, name, group;
    std::optional<std::uint32_t> seed;        ///< the group's, if groups have their own data sets
    std::string mail, moodle, canvas;         ///< address; numbers by which the learning platforms know the student
    std::vector<FormerName> former{};         ///< looked for in documents like what is known now
    std::vector<std::string> other_groups{};  ///< former or additional groups; searched for like `group`
    std::string language{};                   ///< "en" or "fr"; empty if the roster states none
};

/// Our name of a column that a platform's table has: id, name, first, last, group, email, moodle; any other header in
/// lower case.
std::string our_column(const std::string& header);

/// "Participant 900010" as 900010.
std::string digits_at_end(const std::string& text);

/// The known names of a student that an instructor may use for a submission: group, id and name.
std::vector<std::string> known_names_of(const Student& student);

/// The students of a course. The file has a column `id`, and optionally `name`, `group`, `seed`, `email` (or `mail`),
/// `moodle`, `canvas` and `language` (en or fr); others are not read. The columns that Moodle (list of participants,
/// grading worksheet) and Canvas (gradebook) export are known by their own names, in English, French and German: first
/// name and surname become the name, "ID number" and "SIS User ID" the id, "Identifier" the number of Moodle.
class Roster {
  public:
    /// Throws EnvironmentError with file and line: no column id, an id that is empty or occurs twice,
    /// a seed that is not a whole number, a language other than en and fr.
    explicit Roster(const std::filesystem::path& file);
    /// All columns are there.
    explicit Roster(std::vector<Student> students) : students_(std::move(students)) {}

    const std::vector<Student>& students() const { return students_; }
    bool has(const std::string& column) const;  ///< `mail` also for `email`
    /// Of the file, in lower case, platforms' names of them translated; empty without a file.
    const std::vector<std::string>& columns() const { return columns_; }
    std::vector<std::string> unknown_columns() const;  ///< those that no command reads
    bool converted() const { return converted_; }      ///< see TextTable

  private:
    std::vector<Student> students_;
    std::vector<std::string> columns_;
    bool converted_ = false;
};

}  // namespace dynlab::inline course
