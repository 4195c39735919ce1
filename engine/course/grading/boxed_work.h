#pragma once
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "platform/box.h"

namespace dynlab::inline course {

/// What came out of a box.
struct BoxedResult {
    std::optional<nlohmann::json> output;  ///< what the work returned; nothing when it came to no end
    std::string reason;                    ///< then: "it took more than 10 s", "it crashed (signal 11)", ...
    bool timed_out = false;
    double seconds = 0;  ///< wall clock, box and start included
};

/// Runs one piece of work, {"work": "run" | "checks" | "unpack", ...}, with `program` (dynlab) in the box; it may give
/// out so many bytes.
BoxedResult run_boxed(Box& box, const std::filesystem::path& program, const nlohmann::json& job,
                      std::chrono::milliseconds timeout, std::uint64_t output_bytes = Box::Limits{}.output_bytes);

}  // namespace dynlab::inline course
