#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/message.h"
#include "data_io/values/cbor_values.h"
#include "platform/box.h"

namespace dynlab::inline course {

/// What came out of a box. A job is a described struct (data_io/values/described.h) that says its work's name, kWork,
/// and what comes of it, Result, another such; both are CBOR on the pipes.
template <class Result>
struct BoxedResult {
    std::optional<Result> output;  ///< what the work returned; nothing when it did not finish
    Message reason;                ///< then: "it used more than 10 s of processor time", "it crashed (signal 11)", ...
    double seconds = 0;            ///< wall clock, box and start included
    bool waited = false;           ///< the clock's limit ended it, before its processor time was used
};

/// Why a process that should have done its work within `time` has not: "it used more than 10 s of processor time", ...;
/// empty where it has.
Message reason_of_end(const ChildResult& child, const TimeLimits& time);

/// The program beside `dynlab` that does such work: dynlab-boxed, which starts most quickly, or dynlab-course, which
/// makes versions.
std::filesystem::path program_for(const std::string& work, const std::filesystem::path& dynlab);

/// The bytes of it, as the box wrote them.
BoxedResult<std::string> run_boxed_bytes(Box& box, const std::filesystem::path& program, const std::string& work,
                                         const std::string& job, const TimeLimits& time, std::uint64_t output_bytes);

/// Of what is read inside a box and of what comes out of it: texts are made UTF-8.
ValueLimits boxed_limits(std::uint64_t bytes = Box::Limits{}.output_bytes);

/// Runs one piece of work, `boxed WORK`, in the box, by the program for it beside `program` (dynlab). Starting it there
/// comes on top of `time`; its output may have `output_bytes`.
template <class Job>
BoxedResult<typename Job::Result> run_boxed(Box& box, const std::filesystem::path& program, const Job& job,
                                            const TimeLimits& time,
                                            std::uint64_t output_bytes = Box::Limits{}.output_bytes) {
    const BoxedResult<std::string> child = run_boxed_bytes(box, program, Job::kWork, cbor_of(job), time, output_bytes);
    BoxedResult<typename Job::Result> result{{}, child.reason, child.seconds, child.waited};
    if (!child.output) return result;
    try {
        result.output = from_cbor<typename Job::Result>(*child.output, boxed_limits(output_bytes));
    } catch (const ValueError&) {
        result.reason = Message("the result of the run cannot be read");
    }
    return result;
}

}  // namespace dynlab::inline course
