#include "course/boxes/graded_run.h"

#include <chrono>

#include "course/boxes/told_reason.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "figures/gnuplot_renderer.h"
#include "platform/cache.h"
#include "platform/confinement.h"
#include "platform/time_limits.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/runtime/services.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMostOutput = 4u << 20;  // of printed text
constexpr int kOpenFiles = 64;

/// The script as the lesson wants it: its own promises of answers do not count.
PercentScript read_for_grading(const RunJob& job) {
    PercentScript script = read_percent_script(job.script);
    script.header.answers = job.answers;
    return script;
}

RunOptions options_of(const RunJob& job, const PercentScript& script) {
    RunOptions options;
    options.seed = job.seed;
    options.script_folder = script.file.parent_path();
    options.out_folder = std::filesystem::temp_directory_path();
    options.memory_limit_bytes = job.memory_bytes;
    options.output_limit_bytes = kMostOutput;
    options.time = TimeLimits{std::chrono::milliseconds(job.time_ms), job.clock_multiple};
    options.graded = true;
    return options;
}

}  // namespace

GradedRun run_for_grading(const RunJob& job) {
    ProcessLimits limits;
    limits.cpu_seconds = static_cast<int>(job.time_ms / 1000) + 2;  // the script's own limit comes first
    limits.memory_bytes = job.memory_bytes + (2ull << 30);
    limits.open_files = kOpenFiles;
    confine_process(limits);
    try {
        const PercentScript script = read_for_grading(job);
        GnuplotRenderer renderer;
        ReportLanguage language{script.header.language};
        RunOptions options = options_of(job, script);
        std::optional<Cache> cache;
        std::optional<CallCache> calls;
        if (job.recalls) options.call_cache = &calls.emplace(cache.emplace());
        Runtime runtime(options, renderer);
        runtime.services().language = &language;
        const auto start = processor_time();
        GradedRun run = graded_run(runtime.run(script), script);
        if (run.error) run.error = told_outside(*run.error, job.script.parent_path());
        run.lesson = script.header.lesson;
        run.seconds = std::chrono::duration<double>(processor_time() - start).count();
        return run;
    } catch (const DocumentError& error) {
        GradedRun unread;
        unread.began = false;
        unread.error = told_outside(error.message(), job.script.parent_path());
        return unread;
    }
}

}  // namespace dynlab::inline course
