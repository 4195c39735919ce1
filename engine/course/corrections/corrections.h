#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

// Amendments by the instructor. Each amendment is a separate entry with a reason and a line in the journal; the newest
// entry is valid. Received and signed files do not change. All functions throw InvalidArgument for an empty reason, and
// if there is nothing to amend.

/// What a correction is about.
struct SubmissionSelection {
    std::string group, stage = "first";  ///< "first", "review", "final"
    std::string part;    ///< report, slides, script, review, pack; empty: the document and all that came with it
    std::string report;  ///< of a review: the pseudonym of the report; may be empty where the group wrote one only
    std::optional<std::int64_t> number;  ///< number of the version; default: the newest version that is not withdrawn
};

/// The files were received at that time; each gets a further signed receipt. Returns their versions' ids.
std::vector<std::int64_t> correct_arrival(Course& course, const Assignment& assignment,
                                          const SubmissionSelection& requested, Instant received,
                                          const std::string& reason, Instant now);

/// Within a transaction, and without a line in the journal: the same of one version.
void log_arrival(Course& course, const Assignment& assignment, std::int64_t version, Instant received,
                 const std::string& reason, Instant now);
/// The times of receipt are right, however late they are: penalties that wait for it are applied.
void confirm_arrivals(Course& course, const Assignment& assignment, const std::vector<std::int64_t>& versions,
                      Instant now);

/// Withdraws versions, so that they do not count, or reinstates them. Returns the ids of the versions.
std::vector<std::int64_t> withdraw(Course& course, const Assignment& assignment, const SubmissionSelection& requested,
                                   bool withdrawn, const std::string& reason, Instant now);

/// Sets the deadline of one group; without `due`, restores the deadline of the class.
void extend(Course& course, const Assignment& assignment, const std::string& group, const std::string& stage,
            std::optional<Instant> due, const std::string& reason, Instant now);

/// Withholds the report of a group (stage "first") from its reviewers, or a review from the authors, or stops
/// withholding it.
void hold(Course& course, const Assignment& assignment, const SubmissionSelection& requested, bool held,
          const std::string& reason, Instant now);

struct JournalLine {
    Instant at = 0;
    std::string what;
};
/// All that was done, the oldest first.
std::vector<JournalLine> journal_of(Course& course);

}  // namespace dynlab::inline course
