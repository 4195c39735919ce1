// dynlab-boxed: the part of `dynlab boxed` that grading asks for with each submission.
#include <cstdio>
#include <exception>
#include <string_view>

#include "cli/boxed_job.h"
#include "course/checks/check_descriptions.h"
#include "platform/interrupt.h"
#include "platform/memory.h"

int main(int count, char** words) {
    using namespace dynlab;
    keep_freed_memory();
    const InterruptScope interrupts;
    const std::string_view work = count == 3 && std::string_view(words[1]) == "boxed" ? words[2] : "";
    try {
        if (work == RunJob::kWork)
            do_boxed_job(run_for_grading);
        else if (work == ChecksJob::kWork)
            do_boxed_job(try_checks);
        else
            return std::fputs("dynlab-boxed is for dynlab grade, not for people\n", stderr), 2;
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
