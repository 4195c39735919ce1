#include "workflow/process_copy.h"

#include <signal.h>
#include <sys/wait.h>
#include <tbb/global_control.h>

#include "platform/error.h"
#include "platform/process_group.h"
#include "platform/system_call.h"

namespace dynlab::inline workflow {

void end_worker_threads() {
    tbb::task_scheduler_handle threads{tbb::attach{}};
    tbb::finalize(threads, std::nothrow);
}

ProcessCopy::ProcessCopy() {
    end_worker_threads();
    process_ = fork_bound_copy();
    if (process_ < 0) throw EnvironmentError("cannot start a process for the script: {}", system_reason(errno));
}

ProcessCopy::~ProcessCopy() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    wait();
}

void ProcessCopy::wait() {
    retry_interrupted([&] { return ::waitpid(process_, nullptr, 0); });
    process_ = -1;
}

}  // namespace dynlab::inline workflow
