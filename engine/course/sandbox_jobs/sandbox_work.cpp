#include "course/sandbox_jobs/sandbox_work.h"

#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

constexpr auto kStartTime = std::chrono::milliseconds(1500);  // and a last call of a function of Lua

}  // namespace

ValueLimits sandbox_limits(std::uint64_t bytes) {
    constexpr std::size_t kMemoryOfAByte = 40;  // an empty text in a list
    ValueLimits limits;
    limits.bytes = bytes;
    limits.memory = kMemoryOfAByte * bytes;
    limits.depth = 30;
    limits.only_utf8 = true;
    return limits;
}

Message reason_of_end(const ChildResult& child, const TimeLimits& time) {
    if (child.time_limit() == TimeLimit::kProcessor)
        return Message("the run used more than {} s of processor time", time.seconds(TimeLimit::kProcessor));
    if (child.timed_out) return Message("the run did not finish within {} s", time.seconds(TimeLimit::kClock));
    if (child.output_exceeded) return Message("the run printed too much output");
    if (child.exit_code > 128) return Message("the run crashed (signal {})", child.exit_code - 128);
    if (child.exit_code == 0) return {};
    return Message("the run ended with code {}: {}", child.exit_code,
                   child.error_output.substr(0, child.error_output.find('\n')));
}

std::filesystem::path program_for(const std::string& work, const std::filesystem::path& dynlab) {
    return dynlab.parent_path() / (work == "version" ? kCourseProgram : kSandboxProgram);
}

SandboxResult<std::string> run_bytes_in_sandbox(Sandbox& sandbox, const std::filesystem::path& program,
                                                const std::string& work, const std::string& job, const TimeLimits& time,
                                                std::uint64_t output_bytes) {
    const std::filesystem::path inside = sandbox.add_program(program_for(work, program));
    Sandbox::Limits limits;
    limits.time = time;
    limits.time.processor += kStartTime;
    limits.output_bytes = output_bytes;
    const auto start = std::chrono::steady_clock::now();
    const ChildResult child = sandbox.run({inside.string(), "boxed", work}, {}, job, limits);
    SandboxResult<std::string> result;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.reason = reason_of_end(child, time);
    result.waited = child.time_limit() == TimeLimit::kClock;
    if (result.reason.empty()) result.output = child.output;
    return result;
}

}  // namespace dynlab::inline course
