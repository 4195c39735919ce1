#include <fmt/format.h>

#include <map>

#include "base/reader.h"
#include "course/review/oral_marks.h"
#include "course/review/review_marks.h"
#include "course/review/score_sheet.h"
#include "course/store/exceptions.h"
#include "course/store/groups.h"
#include "course/store/newest_versions.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

constexpr double kMostPercent = 200;
constexpr char kInstructor[] = "instructor";

/// The newest points by owner: a pair, or a group.
std::map<std::int64_t, CriterionPoints> newest_points(Rows rows, std::size_t criteria) {
    std::map<std::int64_t, CriterionPoints> points;
    while (rows.next()) {
        CriterionPoints& own = points.try_emplace(rows.integer(0), criteria).first->second;
        const auto c = static_cast<std::size_t>(rows.integer(1));
        if (c < criteria) own[c] = rows.number(2);
    }
    return points;
}

std::map<std::int64_t, CriterionPoints> review_points(Course& course, const Assignment& a) {
    return newest_points(
        course.database().query("SELECT s.pair, s.criterion, s.points FROM scores s JOIN pairs p ON p.id = s.pair "
                                "WHERE p.assignment = ? ORDER BY s.given_at",
                                a.id),
        a.criteria.size());
}

/// By group.
std::map<std::int64_t, CriterionPoints> instructor_points(Course& course, const Assignment& a, const char* stage) {
    return newest_points(course.database().query("SELECT group_id, criterion, points FROM instructor_scores WHERE "
                                                 "assignment = ? AND stage = ? ORDER BY given_at",
                                                 a.id, stage),
                         a.criteria.size());
}

/// Writes what differs from what is known; `owner_of` gives the row's owner, `insert` writes one score.
template <class Owner, class Insert>
int import_scores(Course& course, const Assignment& a, const ScoreSheet& sheet,
                  std::map<std::int64_t, CriterionPoints> known, const Owner& owner_of, const Insert& insert) {
    Transaction transaction(course.database());
    int fresh = 0;
    for (std::size_t row = 0; row < sheet.rows(); ++row) {
        const std::int64_t owner = sheet.at(row, [&] { return owner_of(row); });
        CriterionPoints& own = known.try_emplace(owner, a.criteria.size()).first->second;
        for (std::size_t c = 0; c < a.criteria.size(); ++c) {
            const auto points = sheet.points(row, c);
            if (!points || own[c] == points) continue;
            insert(owner, static_cast<std::int64_t>(c), *points);
            own[c] = points;
            ++fresh;
        }
    }
    if (fresh > 0)
        course.note(fmt::format("{}: {}", a.name, message_text(plural(fresh, "{} score read", "{} scores read"))));
    transaction.commit();
    return fresh;
}

/// The group whose report is called so, by its pseudonym or its own name.
std::int64_t author_called(Course& course, const std::vector<ReviewPair>& pairs, const std::string& report) {
    for (const ReviewPair& pair : pairs)
        if (pair.report_pseudonym() == report) return pair.author;
    return group_named(course, report).id;
}

void add_instructor_score(Course& course, const Assignment& a, std::int64_t group, const char* stage,
                          std::int64_t criterion, double points, Instant now) {
    course.database().run(
        "INSERT INTO instructor_scores VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO UPDATE SET points = excluded.points",
        a.id, group, stage, criterion, now, points);
}

/// Takes what is late or missing off the marks of groups.
class CostTaker {
  public:
    CostTaker(Course& course, const Assignment& a, Instant now)
        : course_(course), a_(a), now_(now), versions_(newest_versions(course, a)), pairs_(review_pairs(course, a)) {}

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
        mark.costs.push_back(Message("{} off for {}", significant(points, 6), why));
    }

    void take_off_work(GroupMark& mark) {
        const char* const part = a_.document();
        for (const char* stage : {"first", "final"}) {
            const HandedInParts& parts = versions_[mark.group][stage];
            const auto found = parts.find(part);
            if (found == parts.end() || !found->second.is_late()) continue;
            take(mark, mark.work, late_percent(a_.costs, found->second.late),
                 std::string_view(stage) == "first"
                     ? Message("a first version late by {}", duration_message(found->second.late))
                     : Message("a final version late by {}", duration_message(found->second.late)));
        }
        if (a_.is_report() && versions_[mark.group]["final"].empty() && over(mark, "final"))
            take(mark, mark.work, a_.costs.missing_final, Message("a missing final version"));
    }

    void take_off_reviews(GroupMark& mark) {
        int missing = 0, late = 0, written = 0;
        for (const ReviewPair& pair : pairs_) {
            if (pair.reviewer != mark.group || pair.ended) continue;
            written += pair.written, late += pair.late, missing += !pair.written && over(mark, "review");
        }
        if (missing > 0 && written == 0 && a_.costs.missing_review > 0 && !mark.reviews) mark.reviews = 0;
        take(mark, mark.reviews, a_.costs.missing_review * missing,
             plural(missing, "{} missing review", "{} missing reviews"));
        take(mark, mark.reviews, a_.costs.late_review * late, plural(late, "{} late review", "{} late reviews"));
    }

    Course& course_;
    const Assignment& a_;
    Instant now_;
    std::map<std::int64_t, std::map<std::string, HandedInParts>> versions_;
    std::vector<ReviewPair> pairs_;
};

}  // namespace

int import_review_scores(Course& course, const Assignment& a, const std::filesystem::path& file, Instant now) {
    const ScoreSheet sheet(a, file, {"reviewer"}, {"report"});
    const std::vector<ReviewPair> pairs = review_pairs(course, a);
    // What the instructor scores belongs to the group, with its sign changed; what a group scores to the pair.
    std::map<std::int64_t, CriterionPoints> known = review_points(course, a);
    for (const auto& [group, points] : instructor_points(course, a, "first")) known[-group] = points;
    return import_scores(
        course, a, sheet, known,
        [&](std::size_t row) {
            if (sheet.cell(row, "reviewer") == kInstructor)
                return -author_called(course, pairs, sheet.cell(row, "report"));
            return reviewed_pair(pairs, group_named(course, sheet.cell(row, "reviewer")), sheet.cell(row, "report")).id;
        },
        [&](std::int64_t owner, std::int64_t c, double points) {
            if (owner < 0)
                add_instructor_score(course, a, -owner, "first", c, points, now);
            else
                add_review_score(course, owner, c, points, now);
        });
}

void add_review_score(Course& course, std::int64_t pair, std::int64_t criterion, double points, Instant now) {
    course.database().run("INSERT INTO scores VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE SET points = excluded.points",
                          pair, criterion, now, points);
}

int import_final_scores(Course& course, const Assignment& a, const std::filesystem::path& file, Instant now) {
    refuse_without_reviews(a);
    const ScoreSheet sheet(a, file, {"group"});
    return import_scores(
        course, a, sheet, instructor_points(course, a, "final"),
        [&](std::size_t row) { return group_named(course, sheet.cell(row, "group")).id; },
        [&](std::int64_t group, std::int64_t c, double points) {
            add_instructor_score(course, a, group, "final", c, points, now);
        });
}

void override_mark(Course& course, const Assignment& a, const std::string& group, const std::string& what,
                   double percent, const std::string& reason, Instant now) {
    if (what == "reviews") refuse_without_reviews(a);
    if (reason.empty()) throw InvalidArgument("say why: --reason \"...\"; it stands in the export");
    if (!(percent >= 0 && percent <= kMostPercent))
        throw InvalidArgument("a mark is a number from 0 to {} percent, but {} was given", kMostPercent, percent);
    Transaction transaction(course.database());
    const Group whose = group_named(course, group);
    course.database().run(
        "INSERT INTO overrides (assignment, group_id, what, percent, reason, made_at) VALUES (?, ?, ?, ?, ?, ?)", a.id,
        whose.id, what, percent, reason, now);
    course.note(fmt::format("{}: {} of {} set to {} percent: {}", a.name, what, whose.name, percent, reason), now);
    transaction.commit();
}

void take_back_override(Course& course, const Assignment& a, const std::string& group, const std::string& what,
                        const std::string& reason, Instant now) {
    refuse_without_reason(reason);
    Transaction transaction(course.database());
    const Group whose = group_named(course, group);
    Rows newest = course.database().query(
        "SELECT percent FROM overrides WHERE assignment = ? AND group_id = ? AND what = ? ORDER BY id DESC LIMIT 1",
        a.id, whose.id, what);
    if (!newest.next() || newest.isColumnNull(0))
        throw InvalidArgument("you have set no mark of {} for its {}", whose.name, what);
    course.database().run(
        "INSERT INTO overrides (assignment, group_id, what, percent, reason, made_at) VALUES (?, ?, ?, NULL, ?, ?)",
        a.id, whose.id, what, reason, now);
    course.note(fmt::format("{}: {} of {} is that of the scores again; reason: {}", a.name, what, whose.name, reason),
                now);
    transaction.commit();
}

Marks course_marks(Course& course, const Assignment& a, Instant now) {
    std::vector<ScoredReview> reviews;
    if (a.is_report()) {
        const auto points = review_points(course, a);
        for (const ReviewPair& pair : review_pairs(course, a))
            if (const auto own = points.find(pair.id); own != points.end())
                reviews.push_back({pair.id, pair.reviewer, pair.author, own->second});
        for (const auto& [group, own] : instructor_points(course, a, "first")) reviews.push_back({0, 0, group, own});
    } else {
        for (const auto& [group, own] : oral_points(course, a)) reviews.push_back({0, 0, group, own});
    }
    std::vector<std::int64_t> ids;
    for (const Group& group : groups_of(course)) ids.push_back(group.id);
    Marks marks = marks_of(a.criteria, reviews, ids);
    const auto finals = instructor_points(course, a, "final");
    CostTaker costs(course, a, now);
    for (GroupMark& mark : marks.groups) {
        if (const auto own = finals.find(mark.group); own != finals.end())
            mark.final_version = percent_of(a.criteria, own->second);
        if (mark.final_version) {
            const double share = mark.work ? a.final_weight / 100 : 1;
            mark.work = (1 - share) * mark.work.value_or(0) + share * *mark.final_version;
        }
        costs.apply(mark);
    }
    if (!a.is_report()) add_student_marks(course, a, marks.groups);
    for (Rows rows = course.database().query(
             "SELECT group_id, what, percent, reason FROM overrides WHERE assignment = ? ORDER BY id", a.id);
         rows.next();)
        for (GroupMark& mark : marks.groups) {
            if (mark.group != rows.integer(0)) continue;
            const bool work = rows.text(1) == "work", holds = !rows.isColumnNull(2);
            (work ? mark.work_override : mark.reviews_override) = holds ? std::optional(rows.number(2)) : std::nullopt;
            (work ? mark.work_reason : mark.reviews_reason) = holds ? rows.text(3) : "";
        }
    return marks;
}

}  // namespace dynlab::inline course
