#pragma once
#include "course/grading/class_folder.h"
#include "course/grading/grade_class.h"

namespace dynlab::inline course {

/// Grades a folder of submissions without a course. `options.out` remembers what it was made with (grading_memory.h).
struct FolderRequest {
    GradingOptions options;
    ClassSources sources;
    bool again = false;  ///< all again where `out` was made with other checks or options
};

/// Throws EnvironmentError for what must be fixed first; and where `out` was made with something else, unless `again`
/// is set.
GradingOutcome grade_folder(const FolderRequest& request);

}  // namespace dynlab::inline course
