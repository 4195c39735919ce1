#include "course/grading/grade_folder.h"

#include "course/grading/grading_memory.h"
#include "platform/error.h"

namespace dynlab::inline course {

GradingOutcome grade_folder(const FolderRequest& request) {
    const GradingOptions& options = request.options;
    if (const auto obstacle = obstacle_to(options.setup.isolation)) throw EnvironmentError(*obstacle);
    const FileLock lock = lock_results(options.out);
    const ClassFolder folder(request.sources, options.out, options.setup);
    const TriedRules tried(options);
    remember_inputs(request);
    return grade_class(folder.work(), tried, options);
}

}  // namespace dynlab::inline course
