#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

// What an instructor corrects later. Every correction is an entry of its own with a reason, the newest of which holds,
// and a line in the journal; what was received and signed stays as it was. All throw InvalidArgument for a reason that
// is empty, and where there is nothing to be corrected.

/// What a correction is about.
struct HandedInWanted {
    std::string group, stage = "first";  ///< "first", "review", "final"
    std::string part;    ///< report, slides, script, review, pack; empty: the document and all that came with it
    std::string report;  ///< of a review: the pseudonym of the report; may be empty where the group wrote one only
    std::optional<std::int64_t> number;  ///< of the version; the newest that stands unless given
};

/// The files were received at that time; each gets a further signed receipt. Returns their versions' ids.
std::vector<std::int64_t> correct_arrival(Course& course, const Assignment& assignment, const HandedInWanted& wanted,
                                          Instant received, const std::string& reason, Instant now);

/// Within a transaction, and without a line in the journal: the same of one version.
void record_arrival(Course& course, const Assignment& assignment, std::int64_t version, Instant received,
                    const std::string& reason, Instant now);
/// The times of receipt are right, however late they are: penalties that wait for it are applied.
void confirm_arrivals(Course& course, const Assignment& assignment, const std::vector<std::int64_t>& versions,
                      Instant now);

/// Withdraws versions, as if they had not come, or lets them stand again. Returns their ids.
std::vector<std::int64_t> withdraw(Course& course, const Assignment& assignment, const HandedInWanted& wanted,
                                   bool withdrawn, const std::string& reason, Instant now);

/// A deadline of its own for one group; without `due` that of all again.
void extend(Course& course, const Assignment& assignment, const std::string& group, const std::string& stage,
            std::optional<Instant> due, const std::string& reason, Instant now);

/// Keeps a group's report (stage "first") from its reviewers, or a review from the authors, or gives it free again.
void hold(Course& course, const Assignment& assignment, const HandedInWanted& wanted, bool held,
          const std::string& reason, Instant now);

struct JournalLine {
    Instant at = 0;
    std::string what;
};
/// All that was done, the oldest first.
std::vector<JournalLine> journal_of(Course& course);

}  // namespace dynlab::inline course
