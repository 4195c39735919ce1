#include "course/checks/check_run.h"

#include <chrono>
#include <cstdlib>

#include "course/checks/check_descriptions.h"
#include "course/checks/read_checks.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "platform/confinement.h"
#include "platform/guarded_call.h"

namespace dynlab::inline course {
namespace {

constexpr std::uint64_t kMaxCheckResultBytes = 4u << 20;  // bytes of what the checks say of one submission

/// In a copy of this process.
GradedSubmission result_from_copy(const ChecksJob& job, const SubmissionToGrade& submission) {
    GuardLimits limits;
    limits.time = {std::chrono::milliseconds(job.most_ms), job.clock_multiple};
    limits.memory_bytes = ProcessLimits().memory_bytes;
    limits.output_bytes = kMaxCheckResultBytes;
    limits.one_task = false;  // checks read files of several kinds
    const auto start = std::chrono::steady_clock::now();
    const ChildResult copy = run_guarded(
        [&] {
            ::setenv("DYNLAB_HOME", submission.home.c_str(), 1);
            GradedSubmission submission_result;
            ReadChecks checks(job, &submission);
            if (checks.error())
                submission_result.reason = *checks.error();
            else
                submission_result.checks = checks.evaluated(job.only);
            return cbor_of(submission_result);
        },
        limits);
    GradedSubmission submission_result;
    submission_result.reason = reason_of_end(copy, limits.time);
    try {
        if (submission_result.reason.empty())
            submission_result = from_cbor<GradedSubmission>(copy.output, sandbox_limits(kMaxCheckResultBytes));
    } catch (const ValueError&) {
        submission_result.reason = Message("the result of the run cannot be read");
    }
    submission_result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return submission_result;
}

}  // namespace

CheckResults try_checks(const ChecksJob& job) {
    CheckResults results;
    if (job.submissions.empty()) {
        confine_process({});
        ReadChecks checks(job, nullptr);
        if (!checks.error()) return checks.listed(job.data_sets);
        results.error = checks.error();
        return results;
    }
    limit_process({});
    hide_memory();
    for (const SubmissionToGrade& submission : job.submissions)
        results.judged.push_back(result_from_copy(job, submission));
    return results;
}

}  // namespace dynlab::inline course
