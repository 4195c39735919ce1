#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "course/grading/work_item.h"
#include "course/intake/owners.h"
#include "course/intake/submission.h"
#include "data_io/text_table.h"

namespace dynlab::inline course {

/// The file of the instructor's own marks in a folder of results.
inline constexpr char kMarksFile[] = "marks.csv";

/// The rows of that file: who (a group in any spelling, a student's name or id, or a submission's name), check (or *
/// for the whole submission), points and reason, which the student reads. dynlab adds rows that are to be filled in and
/// never takes one away or changes one that is filled. manual.csv and by_hand.csv of earlier versions are taken in
/// once.
class MarksFile {
  public:
    struct Row {
        int line = 0;
        std::string who, check;
        std::optional<double> points;  ///< nothing: not marked yet
        std::string reason;
    };
    /// Writes an empty table with its header where there is none. Throws EnvironmentError with file and line.
    explicit MarksFile(const std::filesystem::path& results);

    const std::vector<Row>& rows() const { return rows_; }
    /// Rows whose who and check the file does not have yet; of others the cells after `points` are left as they are.
    void add(const std::vector<Row>& rows, const std::vector<std::vector<std::string>>& more = {});
    /// Fills in the rows of this who and check.
    void fill(const std::string& who, const std::string& check, std::optional<double> points,
              const std::string& reason);

  private:
    void take_in(const std::filesystem::path& former);
    void read();
    void write() const;

    std::filesystem::path file_;
    TextTable table_;
    std::size_t who_ = 0, check_ = 0, points_ = 0, reason_ = 0;
    std::vector<Row> rows_;
};

/// Finds what a row is about.
class MarkedItems {
  public:
    explicit MarkedItems(const ClassWork& work) : work_(work), owners_(work.students) {}

    struct Found {
        std::vector<const WorkItem*> items;
        bool by_name = false;  ///< `who` is the name of a submission; else it means all those of an owner
        Message error_reason;  ///< a clause, where there are none; empty for someone who submitted nothing
    };
    Found find(const std::string& who) const;

  private:
    std::optional<std::size_t> student_called(const std::string& who) const;

    const ClassWork& work_;
    Owners owners_;
};

}  // namespace dynlab::inline course
