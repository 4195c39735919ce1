#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/hand_ins/submission.h"

namespace dynlab::inline course {

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

    struct Lateness {
        double hours = 0, percent = 0;  ///< of the points earned; 0 in time
        long came = 0, deadline = 0;    ///< seconds since 1970
        double percent_per_day = 0, most_percent = 100;
        /// "received 2026-03-01 18:20 CET, 20 min after the deadline of 2026-03-01 18:00 CET; each begun day costs 10 %
        /// of the points"; empty in time
        Message reason() const;
    };
    /// `also`: by what else the submission may be named in the table: its owners' group, ids and names. A row of its
    /// own name goes first; of several others the one with the latest deadline holds.
    Lateness of(const Submission& submission, const std::vector<std::string>& also) const;
    /// When it was received: as the table has it, else by the time of the archive or the newest file; seconds since
    /// 1970.
    long received(const Submission& submission, const std::vector<std::string>& also) const;
    /// The names in the table that are none of these, nor those of the submissions.
    std::vector<std::string> strays(const std::vector<Submission>& submissions,
                                    const std::vector<std::string>& known) const;

  private:
    struct Rule {
        long deadline = 0;
        std::optional<long> received;
        long grace = 0;
        double percent_per_day = 10, most_percent = 100;
    };
    const Rule* rule_for(const Submission& submission, const std::vector<std::string>& also) const;

    std::map<std::string, Rule> rules_;
};

}  // namespace dynlab::inline course
