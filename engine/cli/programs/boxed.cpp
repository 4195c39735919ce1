// dynlab-boxed: runs scripts and checks, unpacks archives and makes documents in sandboxes, a process for each.
#include <cstdio>
#include <exception>
#include <string_view>

#include "cli/sandbox_job.h"
#include "course/checks/check_descriptions.h"
#include "course/sandbox_jobs/sandboxed_document.h"
#include "course/sandbox_jobs/unpack.h"
#include "platform/interrupt.h"
#include "platform/memory.h"

int main(int count, char** args) {
    using namespace dynlab;
    keep_freed_memory();
    const InterruptScope interrupts;
    const std::string_view work = count == 3 && std::string_view(args[1]) == "boxed" ? args[2] : "";
    try {
        if (work == RunJob::kWork)
            do_sandbox_job(run_for_grading);
        else if (work == ChecksJob::kWork)
            do_sandbox_job(try_checks);
        else if (work == UnpackJob::kWork)
            do_sandbox_job(unpack_archive);
        else if (work == DocumentJob::kWork)
            do_sandbox_job(make_sandboxed_document);
        else
            return std::fputs("dynlab-boxed is an internal program of dynlab grade\n", stderr), 2;
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
