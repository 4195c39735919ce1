#include "course/grading/grade_folder.h"

#include "course/grading/grading_memory.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

std::optional<FileLock> lock_for(const FolderRequest& request) {
    if (const auto obstacle = obstacle_to(request.options.setup.isolation)) throw EnvironmentError(*obstacle);
    if (request.part) return {};  // each result is written by one part, and whole
    return lock_results(request.options.out);
}

}  // namespace

FolderGrading::FolderGrading(const FolderRequest& request)
    : request_(request),
      lock_(lock_for(request)),
      folder_(request.sources, request.options.out, request.options.setup),
      tried_(request.options) {
    remember_inputs(request);
}

}  // namespace dynlab::inline course
