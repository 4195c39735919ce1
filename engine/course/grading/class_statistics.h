#pragma once
#include <string>
#include <utility>
#include <vector>

#include "course/grading/grade.h"

namespace dynlab::inline course {

/// How a class did in one check.
struct CheckStatistics {
    std::string id, about;
    double points = 0;
    int graded = 0, passed = 0;
    double mean_share = 0;  ///< of the points, over those graded; 0 to 1
    /// Correlation of the points in this check with those in all others, over works graded completely that gave an
    /// answer (the corrected item-total correlation; work that failed to start fails all checks, which says nothing
    /// of one): about 0 or less where those who are good fail it as often. NaN where it is not defined:
    /// fewer than five works, or all with the same points.
    double discrimination = 0;
    /// What was said where points are missing, and how often; the most frequent first. Numbers of
    /// messages are made "...", so that what differs in a number only counts as one.
    std::vector<std::pair<std::string, int>> mistakes;
};

/// Checks in the order of the first grade; grades without checks are passed over.
std::vector<CheckStatistics> statistics_of_checks(const std::vector<Grade>& grades);

/// Statistics of a class as JSON, for programs: {lesson, works, graded, mean, median, checks: [{id, about, points,
/// graded, passed, mean_share, discrimination, mistakes: [{said, count}]}], results: [{submission, points, possible,
/// penalty, whole, `trouble`, checks: {id: points}}]}; unknown values are null.
std::string class_statistics_json(const std::string& lesson, const std::vector<Grade>& grades);

}  // namespace dynlab::inline course
