#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "course/grading/grade.h"

namespace dynlab::inline course {

/// The instructor's own marks, manual.csv in the folder of results: columns submission, check, points, reason (or
/// comment), which the student reads. They replace what the check gave and survive every regrade. A row without points
/// is not marked yet.
class ManualMarks {
  public:
    /// Writes an empty table with its header where there is none. Throws EnvironmentError with file and line.
    explicit ManualMarks(const std::filesystem::path& file);
    Grade applied(Grade grade) const;
    /// A sentence for each mark whose submission or check is not among these, or that is above the check's points.
    std::vector<Message> strays(const std::set<std::string>& submissions,
                                const std::map<std::string, double>& checks) const;

  private:
    struct Mark {
        double points;
        std::string reason;
    };
    std::map<std::pair<std::string, std::string>, Mark> marks_;
};

}  // namespace dynlab::inline course
