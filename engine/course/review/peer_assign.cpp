#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/reader.h"
#include "course/review/allocation.h"
#include "course/review/peer_review.h"
#include "course/store/assignments.h"
#include "course/store/newest_versions.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

class ReviewAssigner {
  public:
    ReviewAssigner(Course& course, const Assignment& assignment, Instant now)
        : course_(course), db_(course.database()), assignment_(assignment), now_(now), groups_(groups_of(course)) {
        for (std::size_t i = 0; i < groups_.size(); ++i) index_[groups_[i].id] = static_cast<int>(i);
    }

    AssignOutcome run() {
        read();
        add_wished_pairs();
        const Allocation allocation = allocate_reviews(problem_, secure_below);
        outcome_.remarks.insert(outcome_.remarks.end(), allocation.remarks.begin(), allocation.remarks.end());
        give_pseudonyms();
        write(allocation);
        return outcome_;
    }

  private:
    void read() {
        problem_.groups = static_cast<int>(groups_.size());
        problem_.reviews = assignment_.reviews;
        problem_.active.assign(groups_.size(), false);
        for (Rows rows = db_.query(
                 "SELECT DISTINCT group_id FROM standing WHERE assignment = ? AND stage = 'first' AND part = 'report'",
                 assignment_.id);
             rows.next();) {
            const auto index = static_cast<std::size_t>(index_.at(rows.integer(0)));
            problem_.active[index] = !groups_[index].dropped_out;
            outcome_.groups += problem_.active[index];
        }
        for (const auto& [a, b] : kindred_groups(course_))
            if (index_.contains(a) && index_.contains(b)) keep_apart(index_[a], index_[b]);
        for (const PairConstraint& constraint : pair_constraints(course_, assignment_))
            if (constraint.constraint == "forbid")
                keep_apart(index_.at(constraint.reviewer), index_.at(constraint.author));
        for (const ReviewPair& pair : review_pairs(course_, assignment_)) {
            if (pair.ended) continue;
            const ReviewEdge edge(index_.at(pair.reviewer), index_.at(pair.author));
            const bool both = problem_.active[static_cast<std::size_t>(edge.first)] &&
                              problem_.active[static_cast<std::size_t>(edge.second)];
            known_[edge] = pair;
            if (pair.written && refused_.contains(edge))
                outcome_.remarks.push_back(
                    Message("{} has reviewed {}, but the groups share or shared a member, or the pair is forbidden; "
                            "withdraw the review if it must not count.",
                            pair.reviewer_name, pair.author_name));
            if (!pair.written && refused_.contains(edge)) continue;
            (pair.written || (pair.sent && both) ? problem_.fixed : problem_.loose).push_back(edge);
        }
    }

    void keep_apart(int a, int b) {
        problem_.kin.emplace_back(a, b);
        refused_.insert({a, b}), refused_.insert({b, a});
    }

    /// The instructor's own pairs hold as if they had been sent.
    void add_wished_pairs() {
        for (const PairConstraint& constraint : pair_constraints(course_, assignment_)) {
            if (constraint.constraint != "set") continue;
            const ReviewEdge edge(index_.at(constraint.reviewer), index_.at(constraint.author));
            const auto& fixed = problem_.fixed;
            if (std::find(fixed.begin(), fixed.end(), edge) != fixed.end()) continue;
            const bool both = problem_.active[static_cast<std::size_t>(edge.first)] &&
                              problem_.active[static_cast<std::size_t>(edge.second)];
            if (!both || refused_.contains(edge)) {
                const std::string &reviewer = groups_[static_cast<std::size_t>(edge.first)].name,
                                  &author = groups_[static_cast<std::size_t>(edge.second)].name;
                outcome_.remarks.push_back(
                    both
                        ? Message(
                              "{} should review {}, but the groups share or shared a member, or the pair is forbidden.",
                              reviewer, author)
                        : Message(
                              "{} should review {}, but one of the groups has submitted no report or has dropped out.",
                              reviewer, author));
                continue;
            }
            std::erase(problem_.loose, edge);
            problem_.fixed.push_back(edge);
        }
    }

    /// Assigns pseudonyms that reveal nothing about the group: random numbers for each assignment and role, without
    /// repetition.
    void give_pseudonyms() {
        const auto max_number = static_cast<std::size_t>(std::max(99, 3 * problem_.groups));
        for (const char* role : {"author", "reviewer"}) {
            std::map<std::int64_t, std::int64_t> given;
            std::set<std::int64_t> taken;
            for (Rows rows = db_.query("SELECT group_id, number FROM pseudonyms WHERE assignment = ? AND role = ?",
                                       assignment_.id, role);
                 rows.next();) {
                given[rows.integer(0)] = rows.integer(1);
                taken.insert(rows.integer(1));
            }
            for (std::size_t i = 0; i < groups_.size(); ++i) {
                if (!problem_.active[i] || given.contains(groups_[i].id)) continue;
                std::int64_t number = 0;
                do number = 1 + static_cast<std::int64_t>(secure_below(max_number));
                while (!taken.insert(number).second);
                db_.run("INSERT INTO pseudonyms VALUES (?, ?, ?, ?)", assignment_.id, groups_[i].id, role, number);
            }
        }
    }

    void write(const Allocation& allocation) {
        const std::set<ReviewEdge> requested(allocation.pairs.begin(), allocation.pairs.end());
        outcome_.pairs = static_cast<int>(requested.size());
        for (const auto& [edge, pair] : known_) {
            if (requested.contains(edge)) continue;
            const auto gone = [&](int index) { return !problem_.active[static_cast<std::size_t>(index)]; };
            const std::string reason = gone(edge.first)          ? "the reviewer dropped out"
                                       : gone(edge.second)       ? "the author dropped out"
                                       : refused_.contains(edge) ? "they share a member, or are kept apart"
                                                                 : "reassigned to another group";
            db_.run("UPDATE pairs SET ended_at = ?, ended_reason = ? WHERE id = ?", now_, reason, pair.id);
            ++outcome_.ended;
        }
        std::vector<ReviewEdge> fresh;
        for (const ReviewEdge& edge : requested)
            if (!known_.contains(edge)) fresh.push_back(edge);
        outcome_.fresh = static_cast<int>(fresh.size());
        if (outcome_.fresh + outcome_.ended == 0) return;
        db_.run("INSERT INTO allocations (assignment, made_at, explanation) VALUES (?, ?, ?)", assignment_.id, now_,
                message_text(Message("{}", MessageList{allocation.remarks, Join::kLines})));
        const std::int64_t id = db_.getLastInsertRowid();
        for (const auto& [reviewer, author] : fresh)
            db_.run("INSERT INTO pairs (allocation, assignment, reviewer, author) VALUES (?, ?, ?, ?)", id,
                    assignment_.id, groups_[static_cast<std::size_t>(reviewer)].id,
                    groups_[static_cast<std::size_t>(author)].id);
        course_.note(fmt::format("{}: reviews allocated, {} new, {} withdrawn", assignment_.name, outcome_.fresh,
                                 outcome_.ended),
                     now_);
    }

    Course& course_;
    Database& db_;
    const Assignment& assignment_;
    Instant now_;
    std::vector<Group> groups_;
    std::map<std::int64_t, int> index_;
    std::map<ReviewEdge, ReviewPair> known_;
    std::set<ReviewEdge> refused_;  ///< reviewers with a member among the authors, and who is kept apart
    AllocationProblem problem_;
    AssignOutcome outcome_;
};

}  // namespace

std::vector<PairConstraint> pair_constraints(Course& course, const Assignment& assignment) {
    std::vector<PairConstraint> constraints;
    for (Rows rows = course.database().query(
             "SELECT w.reviewer, w.author, w.wish FROM pair_wishes w WHERE w.assignment = ? AND w.wish <> 'free' AND "
             "w.id = (SELECT max(n.id) FROM pair_wishes n WHERE n.assignment = w.assignment AND n.reviewer = "
             "w.reviewer AND n.author = w.author) ORDER BY w.id",
             assignment.id);
         rows.next();)
        constraints.push_back({rows.integer(0), rows.integer(1), rows.text(2)});
    return constraints;
}

void constrain_pair(Course& course, const Assignment& assignment, const std::string& reviewer,
                    const std::string& author, const std::string& constraint, const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    refuse_without_reviews(assignment);
    Transaction transaction(course.database());
    const Group reads = group_named(course, reviewer), writes = group_named(course, author);
    if (reads.id == writes.id) throw InvalidArgument("{} cannot review its own report", reads.name);
    if (constraint == "set")
        for (const auto& [a, b] : kindred_groups(course))
            if ((a == reads.id && b == writes.id) || (a == writes.id && b == reads.id))
                throw InvalidArgument("{} and {} share or shared a member", reads.name, writes.name);
    if (constraint == "set" && !newest_file(course, assignment, writes.id, "first", "report"))
        throw InvalidArgument("{} has submitted no report for {}: there is nothing to review", writes.name,
                              assignment.name);
    const auto enter = [&](const Group& one, const Group& other, const std::string& what) {
        course.database().run(
            "INSERT INTO pair_wishes (assignment, reviewer, author, wish, reason, made_at) VALUES (?, ?, ?, ?, ?, ?)",
            assignment.id, one.id, other.id, what, reason, now);
    };
    enter(reads, writes, constraint);
    if (constraint != "set") enter(writes, reads, constraint);
    course.note(fmt::format("{}: {} {} {}; reason: {}", assignment.name, reads.name,
                            constraint == "set"      ? "is to review"
                            : constraint == "forbid" ? "is kept apart from"
                                                     : "may review again, or not,",
                            writes.name, reason),
                now);
    transaction.commit();
}

AssignOutcome assign_reviews(Course& course, const Assignment& assignment, Instant now, bool early) {
    refuse_without_reviews(assignment);
    if (!early && now <= assignment.first_due + assignment.grace)
        throw InvalidArgument("groups can submit first versions of {} until {}; wait, or give --early", assignment.name,
                              course.clock().show(assignment.first_due + assignment.grace));
    Transaction transaction(course.database());
    AssignOutcome outcome = ReviewAssigner(course, assignment, now).run();
    transaction.commit();
    return outcome;
}

}  // namespace dynlab::inline course
