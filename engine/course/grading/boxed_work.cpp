#include "course/grading/boxed_work.h"

#include <fmt/format.h>

namespace dynlab::inline course {

ValueLimits boxed_limits(std::uint64_t bytes) {
    constexpr std::size_t kMemoryOfAByte = 40;  // an empty text in a list
    ValueLimits limits;
    limits.bytes = bytes;
    limits.memory = kMemoryOfAByte * bytes;
    limits.depth = 30;
    limits.only_utf8 = true;
    return limits;
}

BoxedResult<std::string> run_boxed_bytes(Box& box, const std::filesystem::path& program, const std::string& work,
                                         const std::string& job, std::chrono::milliseconds timeout,
                                         std::uint64_t output_bytes) {
    const std::filesystem::path inside = box.add(program, "/box/dynlab");
    Box::Limits limits;
    limits.timeout = timeout;
    limits.output_bytes = output_bytes;
    const auto start = std::chrono::steady_clock::now();
    const ChildResult child = box.run({inside.string(), "boxed", work}, {}, job, limits);
    BoxedResult<std::string> result;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.timed_out = child.timed_out;
    if (child.timed_out) {
        result.reason = fmt::format("it took more than {} s", static_cast<double>(timeout.count()) / 1000);
    } else if (child.output_exceeded) {
        result.reason = "it gave out too much";
    } else if (child.exit_code > 128) {
        result.reason = fmt::format("it crashed (signal {})", child.exit_code - 128);
    } else if (child.exit_code != 0) {
        result.reason = fmt::format("it ended with code {}: {}", child.exit_code,
                                    child.error_output.substr(0, child.error_output.find('\n')));
    } else {
        result.output = child.output;
    }
    return result;
}

}  // namespace dynlab::inline course
