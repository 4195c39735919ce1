#pragma once
#include <optional>
#include <string>
#include <vector>

#include "course/office/course_grading.h"

namespace dynlab::inline course {

/// A folder of submissions, or a platform's zip, that is graded by one command. `out` holds the results, and in
/// out/course a course of one lab, which remembers everything: what a later call does not name is as it was.
struct FolderRequest {
    std::filesystem::path submissions, out;
    std::string lesson;                            ///< needed for a new `out`
    std::string checks, secret;                    ///< folder and file; kNoFile: none from now on
    std::string timezone, keep;                    ///< default: this machine's, "best"
    std::string isolation;                         ///< "full" (the default) or "process"
    int timeout = 0;                               ///< s; default 60
    std::string roster, owners, deadlines, times;  ///< tables that the course takes in now
    bool again = false;                            ///< although it was made with other checks or options
    bool accept_late = false;                      ///< penalties of half the points or more are applied
    CourseGradingRequest grading;                  ///< the rest of its setup is of these options and of the course
    std::optional<WorkPart> part;                  ///< this part only, while others may work on other parts
};
inline constexpr char kNoFile[] = "none";

/// Whether `out` was made by such a command.
bool is_graded_folder(const std::filesystem::path& out);

class FolderGrading {
  public:
    /// Receives the submissions (receive_class.h), takes in the tables, and tries the rules. Locks `out`, except for a
    /// part. Throws EnvironmentError for what must be fixed first, and where `out` was made with other checks, another
    /// secret or other options, unless `again` is set.
    explicit FolderGrading(FolderRequest request);

    GradingOutcome grade();
    GradingOutcome grade_part() const { return grade_part_of_class(work_->work(), *request_.part, *tried_, options_); }
    MissingParts missing(int parts) const { return ungraded_parts(work_->work(), parts, *tried_, options_); }
    const GradingOptions& options() const { return options_; }

  private:
    void prepare(Course& course);
    void receive(Course& course);
    bool confirm_late(Course& course);

    FolderRequest request_;
    std::optional<FileLock> lock_;
    Assignment assignment_;
    GradingOptions options_;
    std::string memory_;               ///< what the results are made with, for the course
    std::vector<Message> complaints_;  ///< of the roster
    std::optional<EvaluatedRules> tried_;
    std::optional<ClassSubmissions> submissions_;
    std::optional<CourseWork> work_;
};

}  // namespace dynlab::inline course
