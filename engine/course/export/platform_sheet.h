#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "course/intake/roster.h"

namespace dynlab::inline course {

/// A table as a learning platform exports and imports it: Moodle's grading worksheet or Canvas's gradebook. dynlab
/// fills in grades and comments. Every other byte stays unchanged: language and order of the columns, separator,
/// quotes, line ends, byte order mark.
///
/// Columns are recognized by known words in several languages, otherwise by their content:
///
/// * Moodle: a column of participants ("Participant 900001"), and the grade, in the column before the maximum grade.
/// * Canvas: a second column "ID", and assignments with a number after their name ("Lab 4 (1234)").
class PlatformSheet {
  public:
    enum class Platform { kMoodle, kCanvas };
    /// A row that belongs to a person; fields that the file does not contain are empty.
    struct Person {
        std::size_t row = 0;
        std::string number, id, mail, name;  ///< number: of Moodle's participant, or Canvas's ID
    };

    /// `assignment`: the column of Canvas's gradebook to fill in, with or without its number; needed where there are
    /// several. Throws EnvironmentError where the file is neither table, or its column of grades is not recognized.
    PlatformSheet(const std::filesystem::path& file, const std::string& assignment);

    Platform platform() const { return platform_; }
    const std::vector<Person>& people() const { return people_; }
    const std::vector<Message>& unrecognized() const { return unrecognized_; }  ///< sentences
    std::optional<double> maximum() const;  ///< the most points in the column of grades, where the table has it
    void set_grade(const Person& person, const std::string& points);
    void set_comment(const Person& person, const std::string& comment);  ///< where the table has such a column
    std::string text() const;

  private:
    struct Line {
        std::vector<std::string> cells;  ///< with their quotes
        std::string end;                 ///< "\r\n", "\n" or nothing
    };
    void split(std::string_view text);
    void recognize_moodle();
    void recognize_canvas(const std::string& assignment);
    void find_people();
    std::string value(std::size_t row, std::optional<std::size_t> column) const;
    std::vector<std::size_t> rows() const;  ///< as long as the header
    std::optional<std::size_t> maximum_column() const;
    std::string listed_columns() const;
    void put(std::size_t row, std::size_t column, const std::string& text);

    std::filesystem::path file_;
    Platform platform_ = Platform::kMoodle;
    std::string mark_;  ///< byte order mark, if any
    char separator_ = ',';
    bool decimal_comma_ = false;
    std::vector<Line> lines_;
    std::vector<std::string> names_;  ///< of the columns, as words without accents
    std::optional<std::size_t> number_, id_, mail_, name_, grade_, comment_, maximum_;
    std::vector<Person> people_;
    std::vector<Message> unrecognized_;
};

/// A student whose row in the table is wanted; what is not known is empty.
struct SoughtPerson {
    std::string id, mail, name;
    std::string number;  ///< of this platform
};
/// The rows of students, by place in `sought`. The id decides, else the mail, the number, or the name, where they
/// belong to exactly one row and one student.
std::map<std::size_t, PlatformSheet::Person> rows_of(const PlatformSheet& sheet,
                                                     const std::vector<SoughtPerson>& sought);

/// Points as the table has them: of `possible` points, scaled to the maximum of the table.
std::string points_in_sheet(const PlatformSheet& sheet, double points, double possible);

}  // namespace dynlab::inline course
