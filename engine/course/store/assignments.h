#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/store/course_store.h"

namespace dynlab::inline course {

struct Criterion {
    std::string name;
    double most = 5;  ///< points
};

/// What is taken off marks, in percent points.
struct Costs {
    double late_day = 0;                         ///< off the work, for each day or part of a day after the deadline
    double late_most = 100;                      ///< that late_day takes off at most
    double missing_final = 0;                    ///< off the work
    double late_review = 0, missing_review = 0;  ///< off the reviews, for each
};

/// Deadline of what has none: the end of the year 9999.
inline constexpr Instant kNoDeadline = 253402300799;

/// A piece of work with its deadlines. A lab has a script that the checks of its lesson grade; a report has a first
/// version, reviews and a final version; a talk has slides and script with one deadline, and a marking sheet for the
/// oral.
struct Assignment {
    std::int64_t id = 0;
    std::string name, kind = "report", lesson;
    Instant first_due = kNoDeadline;
    std::optional<Instant> review_due, final_due;
    std::int64_t grace = 0;  ///< seconds after a deadline that count as in time
    int reviews = 2;         ///< that each group writes
    std::vector<Criterion> criteria;
    Costs costs;
    double final_weight = 50;    ///< percent of the work's mark, where the final version is scored
    double weight = 1;           ///< in the course's total, beside those of the other assignments
    double reviews_weight = 20;  ///< percent of a report's mark that the mark of the reviews makes
    std::string checks;          ///< of a lab: folder with the instructor's own checks; may be empty
    std::string secret;          ///< of a lab: file from which hidden records are drawn; may be empty
    std::string keep = "best";   ///< of a lab: which of several versions counts, "best" or "newest"

    bool is_report() const { return kind == "report"; }
    bool is_talk() const { return kind == "talk"; }
    bool is_lab() const { return kind == "lab"; }
    /// What stands for the work: report, slides or script.
    const char* document() const { return is_report() ? "report" : is_talk() ? "slides" : "script"; }
};

/// Adds it. The same words again change nothing; other words for an assignment that nobody handed anything in for
/// change it. Returns whether something changed. Throws InvalidArgument: deadlines out of order, a report without them,
/// a lab or a talk with those of a review, a name that cannot be a file name, a change after the first hand-in other
/// than later deadlines or more grace.
bool add_assignment(Course& course, Assignment assignment);

/// Changes deadlines in both directions, grace, lesson, costs and weight of an assignment, at any time; lateness and
/// marks follow. The journal tells what was before, and the reason. Returns whether something changed. Throws
/// InvalidArgument: no reason, deadlines out of order.
bool change_assignment(Course& course, const Assignment& wanted, const std::string& reason);
/// Takes an assignment out. Throws InvalidArgument where something hangs on it: files, pairs, scores, marks.
void remove_assignment(Course& course, const Assignment& assignment, const std::string& reason);

std::vector<Assignment> assignments_of(Course& course);  ///< in the order of their deadlines
/// By name; with an empty name the only one. Throws InvalidArgument.
Assignment assignment_named(Course& course, const std::string& name);

/// Throws InvalidArgument for a lab or a talk.
void refuse_without_reviews(const Assignment& assignment);

/// What being late by `late` seconds costs, in percent: late_day for each day or part of a day, late_most at most.
double late_percent(const Costs& costs, std::int64_t late);

/// "clarity:5, methods:10" as criteria. Throws InvalidArgument.
std::vector<Criterion> criteria_of(const std::string& text);
/// The criteria of an assignment of this kind for which none were given: the questions of the reviews, or content,
/// slides, delivery and answers.
std::vector<Criterion> usual_criteria(const std::string& kind);

/// "late-day:10,missing-review:25"; empty for none. Throws InvalidArgument.
Costs costs_of(const std::string& text);

}  // namespace dynlab::inline course
