#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "course/review/review_pairs.h"
#include "course/store/assignments.h"
#include "course/store/marks.h"

namespace dynlab::inline course {

/// The points for each criterion; a criterion without points has no value.
using CriterionPoints = std::vector<std::optional<double>>;

/// 100 sum of points / sum of most, over what was scored.
std::optional<double> percent_of(const std::vector<Criterion>& criteria, const CriterionPoints& points);

/// Points for criteria, by who gave or has them.
struct GivenPoints {
    std::map<std::int64_t, CriterionPoints> pairs;           ///< by reviewers
    std::map<std::int64_t, CriterionPoints> groups, finals;  ///< by the instructor, for first and final versions
    std::map<std::string, CriterionPoints> students;         ///< by the instructor, for single students
};
GivenPoints points_by_owner(const Assignment& assignment, const std::vector<GivenMark>& marks);

/// The scores of one review. The instructor's own are of reviewer 0.
struct ScoredReview {
    std::int64_t pair = 0, reviewer = 0, author = 0;
    CriterionPoints points;
};

struct ReviewMark {
    std::int64_t pair = 0;
    std::optional<double> distance;  ///< mean over the criteria of |points - median of the others| / max_points
    bool outlier = false;            ///< far below the others: mean of (median of the others - points)/most above 0.35
    bool retaliation = false;        ///< an outlier against a group that had reviewed this reviewer's report badly
};

/// A member of a group with individual points at the oral.
struct StudentMark {
    std::string student;             ///< id
    CriterionPoints points;          ///< the group's where the student has none
    std::optional<double> work;      ///< percent, costs taken off
    std::vector<std::string> zeros;  ///< criteria without points, which count 0
};

struct GroupMark {
    std::int64_t group = 0;
    CriterionPoints medians;              ///< over the reviews of its report
    std::optional<double> work, reviews;  ///< percent, from scores, costs taken off
    std::optional<double> final_version;  ///< percent, from the instructor's scores of it; within `work`
    std::vector<Message> costs_of_work, costs_of_reviews;  ///< what was taken off these
    double work_costs = 0;                                 ///< what was taken off the work, in percent points
    int scored = 0;                                        ///< scored reviews of its report, the instructor's included
    std::vector<std::string> zeros;                        ///< criteria of an oral without points, which count 0
    std::vector<StudentMark> students;                     ///< students whose points differ from those of the group
    const StudentMark* own_points_of(const std::string& student) const;  ///< null where the group's points count
};

/// A mark, and the instructor's word where it is that.
struct FinalMark {
    std::optional<double> percent;
    const GivenMark* given = nullptr;
};

struct Marks {
    std::vector<GroupMark> groups;
    std::vector<ReviewMark> reviews;
    std::vector<GivenMark> given;  ///< all that is in force

    /// What was taken off the marks of a group, or of a member. Nothing is taken off a mark that the instructor gave.
    std::vector<Message> costs_of(const GroupMark& mark, const std::string& student = "") const;
    /// Of a group, or of one of its members: the instructor's word for the student wins, then that for the group, then
    /// the student's own points.
    FinalMark work_of(const GroupMark& mark, const std::string& student = "") const;
    FinalMark reviews_of(const GroupMark& mark, const std::string& student = "") const;
};

/// Marks from scores. A report's mark is 100 sum of medians / sum of maxima. A reviewer's mark is the mean over the
/// reviews of 100 max(0, 1 - 2 d), where d is the distance to the instructor's scores, or to the median of the other
/// reviewers' scores if the instructor gave none. A reviewer whose scores have no counterpart (a report with a single
/// scored review) gets no mark. In medians the instructor counts as one more reviewer. `groups`: the groups to mark.
Marks marks_of(const std::vector<Criterion>& criteria, const std::vector<ScoredReview>& reviews,
               const std::vector<std::int64_t>& groups);

/// The same from the store, with final versions by their weight, and deductions for late or missing work at `now`. A
/// talk has only the instructor's scores: a criterion for which any group has points counts 0 for a group with points
/// that lacks this criterion, and members may have individual points.
Marks course_marks(Course& course, const Assignment& assignment, Instant now = CourseClock::now());

}  // namespace dynlab::inline course
