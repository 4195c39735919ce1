#include "course/sandbox_jobs/graded_run.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <stdexcept>

#include "course/sandbox_jobs/sandbox_messages.h"
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

constexpr std::size_t kMaxPrintedBytes = 4u << 20;  // of printed text
constexpr int kOpenFiles = 64;
constexpr int kClockMultiple = 1000;  // the sandbox's own clock limit comes first

/// Lua's own functions look at no clock: from its limit of processor time on the script is stopped at its next step, so
/// that what it answered before counts. One at a time; on the thread that runs the script.
class StopAtLimit {
  public:
    StopAtLimit(Runtime& runtime, std::chrono::milliseconds limit) {
        stopped_ = &runtime;
        struct sigaction action = {};
        action.sa_handler = [](int) { stopped_->stop_at_next_step(); };
        action.sa_flags = SA_RESTART;
        ::sigaction(SIGVTALRM, &action, nullptr);
        sigevent event = {};
        event.sigev_notify = SIGEV_THREAD_ID;
        event.sigev_signo = SIGVTALRM;
        event._sigev_un._tid = ::gettid();
        if (::timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer_) != 0) throw std::runtime_error("no timer");
        constexpr long kAgain = 20'000'000;  // ns: a coroutine may have begun since
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(limit);
        const itimerspec times = {{0, kAgain}, {seconds.count(), std::chrono::nanoseconds(limit - seconds).count()}};
        ::timer_settime(timer_, 0, &times, nullptr);
    }
    ~StopAtLimit() { ::timer_delete(timer_); }
    StopAtLimit(const StopAtLimit&) = delete;
    StopAtLimit& operator=(const StopAtLimit&) = delete;

  private:
    static inline Runtime* stopped_ = nullptr;
    timer_t timer_ = {};
};

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
    options.output_limit_bytes = kMaxPrintedBytes;
    options.time = TimeLimits{std::chrono::milliseconds(job.time_ms), kClockMultiple};
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
        const StopAtLimit stop(runtime, std::chrono::milliseconds(job.time_ms));
        GradedRun run = graded_run(runtime.run(script), script);
        if (run.error) run.error = without_sandbox_paths(*run.error, job.script.parent_path());
        run.lesson = script.header.lesson;
        run.seconds = std::chrono::duration<double>(processor_time() - start).count();
        return run;
    } catch (const DocumentError& error) {
        GradedRun unread;
        unread.began = false;
        unread.error = without_sandbox_paths(error.message(), job.script.parent_path());
        return unread;
    }
}

}  // namespace dynlab::inline course
