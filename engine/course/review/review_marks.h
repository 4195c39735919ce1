#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/marks.h"

namespace dynlab::inline course {

/// The scores that one review gave, a number a criterion; missing ones are not there. The instructor's own are of
/// reviewer 0.
struct ScoredReview {
    std::int64_t pair = 0, reviewer = 0, author = 0;
    std::vector<std::optional<double>> points;
};

struct ReviewMark {
    std::int64_t pair = 0;
    std::optional<double> distance;  ///< mean over the criteria of |points - median of the others| / most
    bool outlier = false;            ///< far below the others: mean of (median of the others - points)/most above 0.35
    bool retaliation = false;        ///< an outlier against a group that had reviewed this reviewer's report badly
};

/// A member of a group who has points of their own at the oral.
struct StudentMark {
    std::string student;                        ///< id
    std::vector<std::optional<double>> points;  ///< a criterion; the group's where the student has none
    std::optional<double> work;                 ///< percent, costs taken off
    std::vector<std::string> zeros;             ///< criteria without points, which count 0
};

struct GroupMark {
    std::int64_t group = 0;
    std::vector<std::optional<double>> medians;  ///< a criterion, over the reviews of its report
    std::optional<double> work, reviews;         ///< percent, from scores, costs taken off
    std::optional<double> final_version;         ///< percent, from the instructor's scores of it; within `work`
    std::vector<Message> costs;                  ///< what was taken off
    double work_costs = 0;                       ///< what was taken off the work, in percent points
    int scored = 0;                              ///< scored reviews of its report, the instructor's included
    std::vector<std::string> zeros;              ///< criteria of an oral without points, which count 0
    std::vector<StudentMark> students;           ///< those whose points differ from the group's
    std::optional<double> work_override, reviews_override;
    std::string work_reason, reviews_reason;
    std::optional<double> work_mark() const { return work_override ? work_override : work; }
    const StudentMark* own_points_of(const std::string& student) const;  ///< null where the group's points count
    /// Of one member: the instructor's word for the group holds for all of it.
    std::optional<double> work_mark_of(const std::string& student) const;
    std::optional<double> reviews_mark() const { return reviews_override ? reviews_override : reviews; }
};

struct Marks {
    std::vector<GroupMark> groups;
    std::vector<ReviewMark> reviews;
    std::vector<GivenMark> own;  ///< the instructor's word for single students, which goes before that for the group
    /// Item: "work" or "reviews"; null where the group's mark counts.
    const GivenMark* own_mark(const std::string& student, const std::string& item) const;
};

/// Marks from scores. A report's mark is 100 sum of medians / sum of most. A reviewer's is the mean over the reviews of
/// 100 max(0, 1 - 2 d), d the distance to the instructor's scores, and where there are none to the median of the
/// others'; one whose scores nobody else's can be held against (a report with a single scored review) is not marked.
/// The instructor counts as one reviewer among the others in medians. `groups`: to be marked.
Marks marks_of(const std::vector<Criterion>& criteria, const std::vector<ScoredReview>& reviews,
               const std::vector<std::int64_t>& groups);

/// The same from the store: the newest scores and overrides, final versions with their weight, costs of what is late or
/// missing at `now`. Oral scores mark a talk's work.
Marks course_marks(Course& course, const Assignment& assignment, Instant now = CourseClock::now());

/// Reads scores, whole or not at all. Columns: reviewer (a group), report (report-NN; may miss where the group has one)
/// and the criteria; the reviewer "instructor" is the instructor, whose report is a pseudonym or a group. Of final
/// versions by the instructor: group and the criteria. Empty cells change nothing; "-" takes a score back. Points for a
/// group that dropped out or submitted nothing, or of a withdrawn review, are refused. Returns the number of changes.
/// Throws EnvironmentError with file, line and column. Those of an oral: oral_marks.h.
int import_review_scores(Course& course, const Assignment& assignment, const std::filesystem::path& file, Instant now);
/// Within a transaction: the points of one criterion (counted from 0) of one review; without points the score before is
/// taken back.
void add_review_score(Course& course, std::int64_t pair, std::int64_t criterion, std::optional<double> points,
                      Instant now);
int import_final_scores(Course& course, const Assignment& assignment, const std::filesystem::path& file, Instant now);

/// The instructor's word, which always wins; the newest holds. `what`: "work" or "reviews"; up to 200 percent, for what
/// deserves more than all.
void override_mark(Course& course, const Assignment& assignment, const std::string& group, const std::string& what,
                   double percent, const std::string& reason, Instant now);
/// The mark of the scores holds again. Throws InvalidArgument where the instructor has set none.
void take_back_override(Course& course, const Assignment& assignment, const std::string& group, const std::string& what,
                        const std::string& reason, Instant now);

}  // namespace dynlab::inline course
