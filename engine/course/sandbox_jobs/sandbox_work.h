#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/message.h"
#include "data_io/values/cbor_values.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// Result of work in a sandbox. A job is a described struct (data_io/values/described.h) with the name of its work,
/// kWork, and the type of its result, Result, which is also described. Jobs and results are sent through pipes as CBOR.
template <class Result>
struct SandboxResult {
    std::optional<Result> output;  ///< what the work returned; nothing when it did not finish
    Message reason;                ///< then: "it used more than 10 s of processor time", "it crashed (signal 11)", ...
    double seconds = 0;            ///< wall clock, including sandbox and start
    bool waited = false;           ///< the clock's limit ended it, before its processor time was used
};

/// Why a process that should have done its work within `time` has not: "it used more than 10 s of processor time", ...;
/// empty where it has.
Message reason_of_end(const ChildResult& child, const TimeLimits& time);

/// Returns the program that does this work, in the folder of `dynlab`: dynlab-boxed, which starts fastest, or
/// dynlab-course, which creates versions.
std::filesystem::path program_for(const std::string& work, const std::filesystem::path& dynlab);

/// Runs the work and returns the bytes that the sandbox wrote.
SandboxResult<std::string> run_bytes_in_sandbox(Sandbox& sandbox, const std::filesystem::path& program,
                                                const std::string& work, const std::string& job, const TimeLimits& time,
                                                std::uint64_t output_bytes);

/// Limits for values that are read inside a sandbox or come from one. Texts are converted to UTF-8.
ValueLimits sandbox_limits(std::uint64_t bytes = Sandbox::Limits{}.output_bytes);

/// Runs the command `boxed WORK` in the sandbox with the program for this work (see program_for). The time to start the
/// program is added to `time`. The output is limited to `output_bytes`.
template <class Job>
SandboxResult<typename Job::Result> run_in_sandbox(Sandbox& sandbox, const std::filesystem::path& program,
                                                   const Job& job, const TimeLimits& time,
                                                   std::uint64_t output_bytes = Sandbox::Limits{}.output_bytes) {
    const SandboxResult<std::string> child =
        run_bytes_in_sandbox(sandbox, program, Job::kWork, cbor_of(job), time, output_bytes);
    SandboxResult<typename Job::Result> result{{}, child.reason, child.seconds, child.waited};
    if (!child.output) return result;
    try {
        result.output = from_cbor<typename Job::Result>(*child.output, sandbox_limits(output_bytes));
    } catch (const ValueError&) {
        result.reason = Message("the result of the run cannot be read");
    }
    return result;
}

}  // namespace dynlab::inline course
