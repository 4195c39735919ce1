#pragma once
#include <optional>

#include "course/grading/class_folder.h"
#include "course/grading/grade_class.h"

namespace dynlab::inline course {

/// A folder of submissions that is graded without a course.
struct FolderRequest {
    GradingOptions options;
    ClassSources sources;
    std::filesystem::path secret;  ///< file of options.setup.secret; empty without one
    bool again = false;            ///< all again where `out` was made with other checks or options
    std::optional<WorkPart> part;  ///< this part only, while others may work on other parts
};

class FolderGrading {
  public:
    /// Locks `options.out`, except for a part, and remembers in it what it is made with (grading_memory.h). Throws
    /// EnvironmentError for what must be fixed first, and where `out` was made with something else, unless `again` is
    /// set. `request` must outlive it.
    explicit FolderGrading(const FolderRequest& request);

    GradingOutcome grade() const { return grade_class(folder_.work(), tried_, request_.options); }
    GradingOutcome grade_part() const {
        return grade_part_of_class(folder_.work(), *request_.part, tried_, request_.options);
    }
    MissingParts missing(int parts) const { return ungraded_parts(folder_.work(), parts, tried_, request_.options); }

  private:
    const FolderRequest& request_;
    std::optional<FileLock> lock_;
    ClassFolder folder_;
    TriedRules tried_;
};

}  // namespace dynlab::inline course
