#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "data_io/text_table.h"
#include "platform/error.h"

namespace dynlab::inline course {

/// What was given for each criterion; what nobody gave is not there.
using CriterionPoints = std::vector<std::optional<double>>;

/// 100 sum of points / sum of most, over what was scored.
std::optional<double> percent_of(const std::vector<Criterion>& criteria, const CriterionPoints& points);

/// Throws InvalidArgument for a group that dropped out.
void refuse_dropped_out(const Group& group);

/// A cell of a score sheet.
struct ScoreEntry {
    bool given = false;            ///< false: the cell is empty, and the score before stays
    std::optional<double> points;  ///< given without points ("-"): the score before is taken back
};

/// A table of scores as it is typed in: each row has an owner and points.
class ScoreSheet {
  public:
    /// There must be a column of `owners` and one of a criterion; besides them there may be `others`. `assignment`
    /// must outlive it. Throws EnvironmentError with file and line.
    ScoreSheet(const Assignment& assignment, const std::filesystem::path& file, const std::vector<std::string>& owners,
               std::set<std::string> others = {});

    std::size_t rows() const { return table_.rows.size(); }
    std::string cell(std::size_t row, const std::string& name) const;  ///< empty without such a column
    /// Throws EnvironmentError for a cell that is neither empty nor "-" nor a number from 0 to the criterion's most.
    ScoreEntry entry(std::size_t row, std::size_t criterion) const;
    bool has_points(std::size_t row) const;

    /// What `work` throws about a row gets its place.
    template <class Work>
    auto at(std::size_t row, const Work& work) const {
        try {
            return work();
        } catch (const std::runtime_error& error) {
            fail(table_.lines[row], message_of(error));
        } catch (const std::logic_error& error) {
            fail(table_.lines[row], message_of(error));
        }
    }

  private:
    [[noreturn]] void fail(int line, const Message& what) const;

    const Assignment& assignment_;
    std::filesystem::path file_;
    TextTable table_;
};

}  // namespace dynlab::inline course
