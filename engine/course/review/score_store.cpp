#include <fmt/format.h>

#include <algorithm>
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
        if (c < criteria) own[c] = rows.isColumnNull(2) ? std::nullopt : std::optional(rows.number(2));
    }
    return points;
}

/// Without the scores of reviews that are withdrawn now: those that were given while such a review was the newest.
std::map<std::int64_t, CriterionPoints> review_points(Course& course, const Assignment& a) {
    return newest_points(
        course.database().query(
            "SELECT s.pair, s.criterion, s.points FROM scores s JOIN pairs p ON p.id = s.pair WHERE p.assignment = ? "
            "AND NOT EXISTS (SELECT 1 FROM arrived v WHERE v.withdrawn AND v.id = (SELECT w.id FROM versions w WHERE "
            "w.pair = s.pair AND w.part IN ('review', 'pack') AND w.received_at <= s.given_at AND NOT ifnull((SELECT "
            "x.withdrawn FROM withdrawals x WHERE x.version = w.id AND x.made_at < s.given_at ORDER BY x.id DESC LIMIT "
            "1), 0) ORDER BY w.part = 'review' DESC, w.number DESC LIMIT 1)) ORDER BY s.given_at",
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

/// Writes the scores that differ from the known ones. `owner_of` gives the owner of a row and refuses one that cannot
/// have points; `insert` writes one score.
template <class Owner, class Insert>
int import_scores(Course& course, const Assignment& a, const ScoreSheet& sheet,
                  std::map<std::int64_t, CriterionPoints> known, const Owner& owner_of, const Insert& insert) {
    Transaction transaction(course.database());
    int fresh = 0;
    for (std::size_t row = 0; row < sheet.rows(); ++row) {
        const std::int64_t owner = sheet.at(row, [&] { return owner_of(row); });
        CriterionPoints& own = known.try_emplace(owner, a.criteria.size()).first->second;
        for (std::size_t c = 0; c < a.criteria.size(); ++c) {
            const ScoreEntry entry = sheet.entry(row, c);
            if (!entry.given || own[c] == entry.points) continue;
            insert(owner, static_cast<std::int64_t>(c), entry.points);
            own[c] = entry.points;
            ++fresh;
        }
    }
    if (fresh > 0)
        course.note(fmt::format("{}: {}", a.name, message_text(plural(fresh, "{} score read", "{} scores read"))));
    transaction.commit();
    return fresh;
}

/// The group whose report is called so, by its pseudonym or its own name.
Group author_called(Course& course, const std::vector<ReviewPair>& pairs, const std::string& report) {
    for (const ReviewPair& pair : pairs)
        if (pair.report_pseudonym() == report) return group_named(course, pair.author_name);
    return group_named(course, report);
}

/// Throws InvalidArgument for a group that cannot have scores for its report of this stage.
void refuse_without_report(Course& course, const Assignment& a, const Group& group, const char* stage) {
    refuse_dropped_out(group);
    if (newest_file(course, a, group.id, stage, "report") || newest_file(course, a, group.id, stage, "pack")) return;
    throw std::string_view(stage) == "first"
        ? InvalidArgument("{} has submitted no first version of {}: there is nothing to score", group.name, a.name)
        : InvalidArgument("{} has submitted no final version of {}: there is nothing to score", group.name, a.name);
}

void add_instructor_score(Course& course, const Assignment& a, std::int64_t group, const char* stage,
                          std::int64_t criterion, std::optional<double> points, Instant now) {
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
            written += pair.written, late += pair.late > 0, missing += !pair.written && over(mark, "review");
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
            const bool points = sheet.has_points(row);
            if (sheet.cell(row, "reviewer") == kInstructor) {
                const Group author = author_called(course, pairs, sheet.cell(row, "report"));
                if (points) refuse_without_report(course, a, author, "first");
                return -author.id;
            }
            const ReviewPair pair =
                reviewed_pair(pairs, group_named(course, sheet.cell(row, "reviewer")), sheet.cell(row, "report"));
            if (points && pair.withdrawn)
                throw InvalidArgument(
                    "the review of {} by {} is withdrawn: its scores do not count; dynlab course restore takes that "
                    "back",
                    pair.report_pseudonym(), pair.reviewer_name);
            return pair.id;
        },
        [&](std::int64_t owner, std::int64_t c, std::optional<double> points) {
            if (owner < 0)
                add_instructor_score(course, a, -owner, "first", c, points, now);
            else
                add_review_score(course, owner, c, points, now);
        });
}

void add_review_score(Course& course, std::int64_t pair, std::int64_t criterion, std::optional<double> points,
                      Instant now) {
    course.database().run("INSERT INTO scores VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE SET points = excluded.points",
                          pair, criterion, now, points);
}

int import_final_scores(Course& course, const Assignment& a, const std::filesystem::path& file, Instant now) {
    refuse_without_reviews(a);
    const ScoreSheet sheet(a, file, {"group"});
    return import_scores(
        course, a, sheet, instructor_points(course, a, "final"),
        [&](std::size_t row) {
            const Group group = group_named(course, sheet.cell(row, "group"));
            if (sheet.has_points(row)) refuse_without_report(course, a, group, "final");
            return group.id;
        },
        [&](std::int64_t group, std::int64_t c, std::optional<double> points) {
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
    std::map<std::int64_t, std::vector<std::string>> zeros;  // by group
    if (a.is_report()) {
        const auto points = review_points(course, a);
        for (const ReviewPair& pair : review_pairs(course, a))
            if (const auto own = points.find(pair.id); own != points.end() && !pair.ended && !pair.withdrawn)
                reviews.push_back({pair.id, pair.reviewer, pair.author, own->second});
        for (const auto& [group, own] : instructor_points(course, a, "first")) reviews.push_back({0, 0, group, own});
    } else {
        const std::vector<bool> graded = graded_criteria(course, a);
        for (auto& [group, own] : oral_points(course, a)) {
            if (!has_points(own)) continue;
            count_missing_points(a, graded, own, zeros[group]);
            reviews.push_back({0, 0, group, own});
        }
    }
    std::vector<std::int64_t> ids;
    for (const Group& group : groups_of(course)) ids.push_back(group.id);
    Marks marks = marks_of(a.criteria, reviews, ids);
    const auto finals = instructor_points(course, a, "final");
    CostTaker costs(course, a, now);
    for (GroupMark& mark : marks.groups) {
        mark.zeros = zeros[mark.group];
        mark.scored = static_cast<int>(std::ranges::count_if(
            reviews, [&](const ScoredReview& r) { return r.author == mark.group && has_points(r.points); }));
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
    for (GivenMark& mark : marks_in_force(course, a))
        if (!mark.student.empty()) marks.own.push_back(std::move(mark));
    return marks;
}

}  // namespace dynlab::inline course
