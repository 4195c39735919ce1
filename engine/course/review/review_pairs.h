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
    bool sent = false, written = false, released = false;
    bool only_pack = false;     ///< a pack came for it, but no document that somebody could read
    bool late = false;          ///< written, but no version of it was in time
    bool newer_report = false;  ///< sent, but another version of the report stands since, and no review is written
    bool newer_review = false;  ///< released, but another version of the review stands since

    std::string report_pseudonym() const;    ///< "report-17": what the reviewer sees
    std::string reviewer_pseudonym() const;  ///< "reviewer-05": what the authors see
};

/// All pairs of an assignment, ended ones too, by reviewer and author.
std::vector<ReviewPair> review_pairs(Course& course, const Assignment& assignment);

/// The pair of this reviewer whose report's pseudonym stands in `name`; the only one where none does. Throws
/// EnvironmentError that tells which reports the group was given.
ReviewPair reviewed_pair(const std::vector<ReviewPair>& pairs, const Group& reviewer, const std::string& name);

}  // namespace dynlab::inline course
