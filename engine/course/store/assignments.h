#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "course/store/course_store.h"

namespace dynlab::inline course {

struct Criterion {
    std::string name;
    double max_points = 5;  ///< points
};

/// What is taken off marks, in percent points.
struct Costs {
    double late_day = 0;                         ///< off the work, for each day or part of a day after the deadline
    double late_max = 100;                       ///< that late_day takes off at most
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
    double weight = 1;           ///< weight of the assignment in the total of the course
    double reviews_weight = 20;  ///< percent of a report's mark that the mark of the reviews makes
    std::string checks;          ///< of a lab: folder with the instructor's own checks; may be empty
    std::string secret;  ///< of a lab: file with the secret from which hidden data sets are generated; may be empty
    std::string keep = "best";  ///< of a lab: which of several versions counts, "best" or "newest"

    bool is_report() const { return kind == "report"; }
    bool is_talk() const { return kind == "talk"; }
    bool is_lab() const { return kind == "lab"; }
    /// The document of the work: report, slides or script.
    const char* document() const { return is_report() ? "report" : is_talk() ? "slides" : "script"; }
};

/// Adds an assignment, or makes the one of this name as wanted; lateness and marks follow. The history has every
/// difference, and the reason. Returns whether something changed. Throws InvalidArgument: deadlines out of order, a
/// report without them, a lab or a talk with those of a review, a name that cannot be a file name; once work was
/// submitted another kind, or without a reason anything but later deadlines or more grace; other criteria once scores
/// were given.
bool set_assignment(Course& course, Assignment requested, const std::string& reason = "");
/// Takes an assignment out. Throws InvalidArgument where something hangs on it: files, pairs, scores, marks.
void remove_assignment(Course& course, const Assignment& assignment, const std::string& reason);

std::vector<Assignment> assignments_of(Course& course);  ///< in the order of their deadlines
/// By name; with an empty name the only one. Throws InvalidArgument.
Assignment assignment_named(Course& course, const std::string& name);

/// The parts of what is submitted at a stage ("first", "review", "final"): the document first, if there is one, then
/// script and pack. Of a lab, script and pack are two forms of the same.
std::vector<std::string> parts_of(const Assignment& assignment, const std::string& stage);

/// Throws InvalidArgument for a lab or a talk.
void refuse_without_reviews(const Assignment& assignment);

/// What being late by `late` seconds costs, in percent: late_day for each day or part of a day, late_max at most.
double late_percent(const Costs& costs, std::int64_t late);
/// A penalty of half the points or more is more often a wrong time than a late student: it is not applied until the
/// instructor corrected or confirmed the time of receipt.
bool waits_for_confirmation(const Costs& costs, std::int64_t late, bool confirmed);

/// "clarity:5, methods:10" as criteria. Throws InvalidArgument.
std::vector<Criterion> criteria_of(const std::string& text);
/// The criteria of an assignment of this kind for which none were given: the questions of the reviews, or content,
/// slides, delivery and answers.
std::vector<Criterion> usual_criteria(const std::string& kind);

/// "late-day:10,missing-review:25"; empty for none. Throws InvalidArgument.
Costs costs_of(const std::string& text);

// Exceptions for one group, such as an extended deadline. The functions of corrections/corrections.h log each exception
// with a reason; the newest one is valid.

/// Throws InvalidArgument for an empty reason.
void refuse_without_reason(const std::string& reason);

/// The deadline of all. Throws InvalidArgument for a stage that the assignment does not have.
Instant due_of_class(const Assignment& assignment, const std::string& stage);
/// The deadline of a group, extended or not. Throws InvalidArgument for a stage that the assignment does not have.
Instant due_for(Course& course, const Assignment& assignment, std::int64_t group, const std::string& stage);

/// Whether a group's report, or its review of a pair, is held back.
bool is_held(Course& course, const Assignment& assignment, std::int64_t group, std::optional<std::int64_t> pair);

}  // namespace dynlab::inline course
