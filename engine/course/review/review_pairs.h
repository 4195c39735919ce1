#pragma once
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

/// Who reviews whom.
struct ReviewPair {
    std::int64_t id = 0, reviewer = 0, author = 0;
    std::string reviewer_name, author_name;               ///< of the groups: for the instructor only
    std::int64_t report_number = 0, reviewer_number = 0;  ///< pseudonyms in this assignment
    bool ended = false;                                   ///< taken back before the review was written
    bool withdrawn = false;  ///< its review was submitted and withdrawn: its scores do not count
    bool sent = false, written = false, released = false;
    bool only_pack = false;     ///< only a pack was received, without a readable document
    std::int64_t late = 0;      ///< seconds that the least late version of its review is late
    bool newer_report = false;  ///< sent, but a newer version of the report exists, and no review is written
    bool newer_review = false;  ///< released, but a newer version of the review exists

    bool stopped_report = false, stopped_review = false;  ///< the newest version names a member: no copy can be sent
    /// A review that came although the pair had been taken back: kept, without marks.
    bool voluntary() const { return ended && written; }

    std::string report_pseudonym() const;    ///< "report-17": what the reviewer sees
    std::string reviewer_pseudonym() const;  ///< "reviewer-05": what the authors see
};

/// All pairs of an assignment, ended ones too, by reviewer and author.
std::vector<ReviewPair> review_pairs(Course& course, const Assignment& assignment);

/// The id of the newest version of a pair's review, or of its pack if it has no document; 0 if there is no version.
std::int64_t newest_review(Course& course, std::int64_t pair);

/// The pair of this reviewer whose report's pseudonym is in `name`; the only one where `name` has none. Pairs that were
/// taken back after they were sent come last. Throws EnvironmentError that names the reports of the group.
ReviewPair reviewed_pair(const std::vector<ReviewPair>& pairs, const Group& reviewer, const std::string& name);

}  // namespace dynlab::inline course
