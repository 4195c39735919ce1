#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/grading/work_item.h"
#include "course/intake/arrival_times.h"

namespace dynlab::inline course {

/// A deadline, and what missing it costs.
struct LatePolicy {
    std::int64_t deadline = 0, grace = 0;
    double percent_per_day = 10, most_percent = 100;
};
/// Of what was received then; times are shown in the process's time zone.
Lateness lateness_of(const LatePolicy& policy, std::int64_t received);

/// What lateness costs. The table has the columns `submission` (a submission's name, an LMS number, a group, a
/// student's id or name, or * for all), `deadline` (2026-03-01 18:00, local time, seconds optional), and optionally
/// `extra` (time that is granted beyond the deadline of all: "2 d", "3 h"), `received` (when it was received, if not by
/// the archive's own time), `grace` (so late costs nothing: "15 min"), `percent_per_day` (begun days count) and
/// `most_percent`. What a row leaves empty is as in the row of *, there: no grace, 10 and 100 percent.
class Deadlines {
  public:
    Deadlines() = default;
    /// Times are in the process's time zone. Throws EnvironmentError with file, line and column.
    explicit Deadlines(const std::filesystem::path& file);

    /// When submissions were received as the platform says: goes before the times of files.
    void set_times(ArrivalTimes times) { times_ = std::move(times); }

    /// `also`: by what else the submission may be named in the table: its owners' group, ids and names. A row of its
    /// own name goes first; of several others the one with the latest deadline holds.
    Lateness of(const Submission& submission, const std::vector<std::string>& also) const;
    /// When it was received: as the table has it, else by the time of the archive or the newest file; seconds since
    /// 1970.
    long received(const Submission& submission, const std::vector<std::string>& also) const;
    /// The names in the table that are none of these, nor those of the submissions.
    std::vector<std::string> unmatched_names(const std::vector<Submission>& submissions,
                                             const std::vector<std::string>& known) const;

    struct Rule : LatePolicy {
        std::optional<long> received;
    };
    const std::map<std::string, Rule>& rules() const { return rules_; }  ///< by the names in the table; * for all

  private:
    const Rule* rule_for(const Submission& submission, const std::vector<std::string>& also) const;

    std::map<std::string, Rule> rules_;
    ArrivalTimes times_;
};

}  // namespace dynlab::inline course
