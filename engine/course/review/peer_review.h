#pragma once
#include <functional>
#include <string>
#include <vector>

#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"

namespace dynlab::inline course {

struct AssignOutcome {
    int pairs = 0, fresh = 0, ended = 0, groups = 0;
    std::vector<Message> remarks;
};
/// Allocates the reviews of an assignment, or repairs the allocation after late arrivals and drop-outs. Written reviews
/// stay, and so do sent copies while both groups are in the course and no group reviews its own work. Repeated calls
/// change nothing. Throws InvalidArgument before the deadline of the first version (unless `early`), for a talk, and if
/// there are too few groups.
AssignOutcome assign_reviews(Course& course, const Assignment& assignment, Instant now, bool early);

/// What the instructor wants of a pair: "set" (this group reviews that one) or "forbid" (neither reviews the other).
struct PairConstraint {
    std::int64_t reviewer = 0, author = 0;
    std::string constraint;
};
std::vector<PairConstraint> pair_constraints(Course& course, const Assignment& assignment);
/// "set", "forbid", or "free", which takes back what was wished before; for the next assign_reviews. Throws
/// InvalidArgument: no reason, a group and itself, one that shares a member with the other.
void constrain_pair(Course& course, const Assignment& assignment, const std::string& reviewer,
                    const std::string& author, const std::string& constraint, const std::string& reason, Instant now);

/// A copy that must not show whose it is. Only `copy`, one PDF, leaves the course: the text and script of a pack stay,
/// so that only the PDF made from them is searched for names.
struct CopyRequest {
    std::filesystem::path pdf;    ///< as submitted
    std::filesystem::path pack;   ///< its source, where one was submitted with it or later; else empty
    std::filesystem::path copy;   ///< where the clean copy is to be written
    std::vector<Student> people;  ///< all of the course, with group, name, id and mail address
    std::string group = {};       ///< whose it is
    bool accept = false;          ///< make the copy although it has hits
};
struct CopyOutcome {
    bool made = false;
    std::vector<Message> hits;   ///< why there is no copy: sentences with page and remedy
    std::vector<Message> hints;  ///< passages that may name a member; they stop nothing
};
/// Makes an anonymous copy and searches it for names; there is no copy where it finds any, unless they are accepted.
using AnonymousCopier = std::function<CopyOutcome(const CopyRequest&)>;

/// Groups whose documents are sent although names were found in them: "Page" may be a word and not a student.
struct AcceptedHits {
    std::vector<std::string> groups;
    std::string reason;  ///< for the history
};

enum class Way {
    kToReviewers,
    kToAuthors
};  ///< reports to those who review them, reviews to those who wrote the report

struct SendOutcome {
    int sent = 0, before = 0, stopped = 0, waiting = 0;  ///< copies: now; earlier; with hits; of what has not come
    int again = 0;                                       ///< of those now: newer versions of what had been sent before
    int held = 0;                                        ///< that the instructor holds back
    std::vector<std::string> unreviewed, reviewed_once;  ///< of reviews: groups whose report has no or one review
    std::vector<std::string> removed;  ///< files of the outbox that no one may receive any more: taken back, withdrawn
    std::vector<Message> hits;         ///< a line for each document that was stopped
    std::vector<Message> hints;        ///< a line for each sent copy that may name a member
    std::filesystem::path folder;      ///< FOR/NAME.pdf for each receiver
};
/// Creates the copies that are missing or outdated by a newer version (of a report while its review is not written),
/// and puts them into outbox/ASSIGNMENT/WAY/GROUP/. A hit of the anonymity check stops only that copy. Copies on hold
/// are not sent, and copies that no one may receive any more are removed from the outbox. Copies are kept in the store
/// like all submissions. The history contains the accepted hits and the reasons. Throws InvalidArgument for a talk, for
/// reviews that may still arrive (unless `early`), and for `accepted` with an unknown group or without a reason;
/// EnvironmentError for a stored copy that differs from the copy that was made.
SendOutcome send_copies(Course& course, const Assignment& assignment, Way way, Instant now,
                        const AnonymousCopier& copier, bool early = false, const AcceptedHits& accepted = {});

}  // namespace dynlab::inline course
