#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/grading/grade_class.h"
#include "course/office/course_work.h"

namespace dynlab::inline course {

struct CourseGradingRequest {
    GradingSetup setup;             ///< lesson, own checks and secret are those of the assignment
    std::vector<std::string> only;  ///< groups, students or submissions, by any identifier; all when empty
    bool regrade = false, pdf = true, above_maximum = false;
};

/// The folder of an assignment's results: COURSE/marks/ASSIGNMENT.
std::filesystem::path results_folder(const Course& course, const Assignment& assignment);

/// Grades what was submitted for a lab, every version that is not withdrawn. Lateness, extensions, members and marks
/// are those of the course. What the checks give is recorded in the store; marks that the instructor wrote into
/// marks.csv in the folder of results are taken in, and those given by command are written there. Throws
/// InvalidArgument for an assignment that is no lab; EnvironmentError as grade_class does.
GradingOutcome grade_assignment(Course& course, const Assignment& assignment, const CourseGradingRequest& request);

/// The course and the lab that a folder of results belongs to; nothing for other folders. dynlab grade keeps the course
/// in the folder.
struct ResultsCourse {
    std::filesystem::path folder;
    std::string assignment;
    bool own = false;  ///< the course is in the folder of results
};
std::optional<ResultsCourse> course_of_results(const std::filesystem::path& results);

// Its steps, which folder_grading.h takes too.

/// The secret from which hidden data sets are generated. Throws EnvironmentError if the file is missing or empty.
std::string secret_in(const std::filesystem::path& file);
/// Throws InvalidArgument for an assignment that is no lab, EnvironmentError for an empty secret.
GradingOptions grading_options(const Course& course, const Assignment& assignment, const CourseGradingRequest& request,
                               const std::filesystem::path& out);
/// Brings marks.csv, the marks of the store and those of the work together. `file_alone`: a row that is taken out takes
/// its mark back.
void join_marks(Course& course, const Assignment& assignment, CourseWork& work, const EvaluatedRules& evaluated,
                const GradingOptions& options, bool file_alone);
/// Enters what the checks gave.
void save_results(Course& course, const Assignment& assignment, const CourseWork& work,
                  const std::filesystem::path& out);
/// What each student of the work has, of these submissions: the one that counts, with the marks of the course.
std::vector<CountedMark> counted_marks(Course& course, const Assignment& assignment, const ClassWork& work);

}  // namespace dynlab::inline course
