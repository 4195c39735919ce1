#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "platform/keys/secure_random.h"

namespace dynlab::inline course {

/// Reviewer and author, as indices into AllocationProblem::groups.
using ReviewEdge = std::pair<int, int>;

/// Who is to review whom. Groups are 0 .. groups - 1.
struct AllocationProblem {
    int groups = 0;
    int reviews = 1;                ///< that each active group should write and each of their reports get
    std::vector<bool> active;       ///< false: the group dropped out or has submitted nothing
    std::vector<ReviewEdge> kin;    ///< groups who share a member, in either order
    std::vector<ReviewEdge> fixed;  ///< reviews that are written, or sent to an active reviewer of an active author
    std::vector<ReviewEdge> loose;  ///< assigned earlier but not sent yet: kept if possible
};

struct Allocation {
    std::vector<ReviewEdge> pairs;  ///< all that hold now: the fixed ones first, then the others, sorted
    int open_reviews = 0;           ///< reviews that active groups should write, but for which no report was found
    int swapped = 0;                ///< couples who review each other
    std::vector<Message> remarks;   ///< whole sentences: what could not be had, and why
};

/// Allocates reviews at random. No group gets its own report, the same report twice, or the report of a group with a
/// common member. Each active group writes `reviews` reviews, and each of their reports gets as many, or one more if
/// the fixed pairs leave no other way. The function avoids couples who review each other if an exchange of two reviews
/// can. Equal problems and draws give equal results; programs pass secure_below, so that no one can compute the pairs.
/// The algorithm starts from a random circle (reviewer i takes the next ones), which has no such couples while 2
/// reviews < groups. Conflicts with kin and fixed pairs are repaired by augmenting paths (Berge 1957; each path passes
/// loose reviews on along a shortest chain). Throws InvalidArgument if there are too few active groups for that number
/// of reviews and nothing is fixed or loose.
Allocation allocate_reviews(const AllocationProblem& problem, const UniformDraw& draw);

}  // namespace dynlab::inline course
