#include <algorithm>

#include "base/reader.h"
#include "course/review/review_marks.h"
#include "course/store/assignments.h"
#include "course/store/newest_versions.h"

namespace dynlab::inline course {
namespace {

/// Takes what is late or missing off the marks of groups.
class CostTaker {
  public:
    CostTaker(Course& course, const Assignment& a, const std::vector<ReviewPair>& pairs, Instant now)
        : course_(course), a_(a), now_(now), versions_(newest_versions(course, a)), pairs_(pairs) {}

    void apply(GroupMark& mark) {
        take_off_work(mark);
        if (a_.is_report()) take_off_reviews(mark);
    }

  private:
    bool over(const GroupMark& mark, const char* stage) const {
        return now_ > due_for(course_, a_, mark.group, stage) + a_.grace;
    }

    void take(GroupMark& mark, std::optional<double>& from, double points, const Message& why) const {
        const bool work = &from == &mark.work;  // of a talk, students may have points where their group has none
        if (points <= 0 || (!from && (!work || a_.is_report()))) return;
        if (from) from = std::max(0.0, *from - points);
        if (work) mark.work_costs += points;
        (work ? mark.costs_of_work : mark.costs_of_reviews)
            .push_back(Message("{} % deducted for {}", significant(points, 6), why));
    }

    void take_off_work(GroupMark& mark) {
        const char* const part = a_.document();
        for (const char* stage : {"first", "final"}) {
            const SubmittedParts& parts = versions_[mark.group][stage];
            const auto found = parts.find(part);
            if (found == parts.end() || !found->second.is_late()) continue;
            const double percent = late_percent(a_.costs, found->second.late);
            const Message why = std::string_view(stage) == "first"
                                    ? Message("a first version late by {}", duration_message(found->second.late))
                                    : Message("a final version late by {}", duration_message(found->second.late));
            if (waits_for_confirmation(a_.costs, found->second.late, found->second.confirmed))
                mark.costs_of_work.push_back(Message(
                    "{} % for {} is not deducted until you confirm the time of receipt with dynlab course set-received",
                    significant(percent, 6), why));
            else
                take(mark, mark.work, percent, why);
        }
        if (a_.is_report() && versions_[mark.group]["final"].empty() && over(mark, "final"))
            take(mark, mark.work, a_.costs.missing_final, Message("a missing final version"));
    }

    void take_off_reviews(GroupMark& mark) {
        // One that was stopped by a name is no fault of the reviewer's. Where dynlab sent nothing, others did.
        const bool sent = std::ranges::any_of(pairs_, &ReviewPair::sent);
        int missing = 0, late = 0, written = 0;
        for (const ReviewPair& pair : pairs_) {
            if (pair.reviewer != mark.group || pair.ended) continue;
            written += pair.written, late += pair.late > 0;
            missing += (pair.sent || !sent) && !pair.written && over(mark, "review");
        }
        if (missing > 0 && written == 0 && a_.costs.missing_review > 0 && !mark.reviews) mark.reviews = 0;
        take(mark, mark.reviews, a_.costs.missing_review * missing,
             plural(missing, "{} missing review", "{} missing reviews"));
        take(mark, mark.reviews, a_.costs.late_review * late, plural(late, "{} late review", "{} late reviews"));
    }

    Course& course_;
    const Assignment& a_;
    Instant now_;
    std::map<std::int64_t, std::map<std::string, SubmittedParts>> versions_;
    const std::vector<ReviewPair>& pairs_;
};

/// The criteria of a talk for which anybody has points.
std::vector<bool> graded_criteria(const Assignment& a, const GivenPoints& given) {
    std::vector<bool> graded(a.criteria.size());
    const auto see = [&](const auto& all) {
        for (const auto& [owner, points] : all)
            for (std::size_t c = 0; c < graded.size(); ++c) graded[c] = graded[c] || points[c];
    };
    see(given.groups), see(given.students);
    return graded;
}

/// Sets the missing points of graded criteria to 0; returns the names of these.
std::vector<std::string> count_missing_points(const Assignment& a, const std::vector<bool>& graded,
                                              CriterionPoints& points) {
    std::vector<std::string> zeros;
    for (std::size_t c = 0; c < points.size(); ++c) {
        if (points[c] || !graded[c]) continue;
        points[c] = 0;
        zeros.push_back(a.criteria[c].name);
    }
    return zeros;
}

/// Marks of members with individual points at the oral. Deductions from the group's mark also apply to theirs.
void add_student_marks(Course& course, const Assignment& a, const GivenPoints& given, std::vector<GroupMark>& marks) {
    const std::vector<bool> graded = graded_criteria(a, given);
    const auto authors = author_groups(course, a);
    for (const auto& [id, own] : given.students) {
        const auto author = authors.find(id);
        const auto mark =
            author == authors.end() ? marks.end() : std::ranges::find(marks, author->second, &GroupMark::group);
        if (mark == marks.end()) continue;
        StudentMark student{id, mark->medians, {}, {}};
        for (std::size_t c = 0; c < own.size(); ++c)
            if (own[c]) student.points[c] = own[c];
        student.zeros = count_missing_points(a, graded, student.points);
        student.work = percent_of(a.criteria, student.points);
        if (student.work) student.work = std::max(0.0, *student.work - mark->work_costs);
        mark->students.push_back(std::move(student));
    }
}

}  // namespace

Marks course_marks(Course& course, const Assignment& a, Instant now) {
    std::vector<GivenMark> in_force = marks_in_force(course, a);
    GivenPoints given = points_by_owner(a, in_force);
    const std::vector<ReviewPair> pairs = review_pairs(course, a);
    std::vector<ScoredReview> reviews;
    for (const ReviewPair& pair : pairs)
        if (const auto own = given.pairs.find(pair.id); own != given.pairs.end() && !pair.ended && !pair.withdrawn)
            reviews.push_back({pair.id, pair.reviewer, pair.author, own->second});
    std::map<std::int64_t, std::vector<std::string>> zeros;  // by group
    for (auto [group, own] : given.groups) {
        if (a.is_talk()) zeros[group] = count_missing_points(a, graded_criteria(a, given), own);
        reviews.push_back({0, 0, group, std::move(own)});
    }
    std::vector<std::int64_t> ids;
    for (const Group& group : groups_of(course)) ids.push_back(group.id);
    Marks marks = marks_of(a.criteria, reviews, ids);
    CostTaker costs(course, a, pairs, now);
    for (GroupMark& mark : marks.groups) {
        mark.zeros = zeros[mark.group];
        mark.scored = static_cast<int>(std::ranges::count(reviews, mark.group, &ScoredReview::author));
        if (const auto own = given.finals.find(mark.group); own != given.finals.end())
            mark.final_version = percent_of(a.criteria, own->second);
        if (mark.final_version) {
            const double share = mark.work ? a.final_weight / 100 : 1;
            mark.work = (1 - share) * mark.work.value_or(0) + share * *mark.final_version;
        }
        costs.apply(mark);
    }
    if (a.is_talk()) add_student_marks(course, a, given, marks.groups);
    marks.given = std::move(in_force);
    return marks;
}

}  // namespace dynlab::inline course
