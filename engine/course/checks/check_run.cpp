#include "course/checks/check_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "course/boxes/boxed_work.h"
#include "course/boxes/told_reason.h"
#include "course/checks/check_descriptions.h"
#include "course/checks/check_functions.h"
#include "course/checks/check_records.h"
#include "course/checks/check_session.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/confinement.h"
#include "platform/guarded_call.h"
#include "platform/time_limits.h"
#include "scripting/interpreter/runtime.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kLongestMessage = 400;

Message shortened_message(const Message& message) {
    return with_changed_text(message, [](const std::string& text) {
        const std::string line = replaced(text, "\n", " ");
        return line.size() > kLongestMessage ? line.substr(0, kLongestMessage) + " ..." : line;
    });
}

/// Tries every check, or the only one wanted, each with a time limit of its own.
std::vector<TriedCheck> verdicts(Runtime& runtime, CheckSession& session, std::optional<std::size_t> only) {
    std::vector<TriedCheck> all;
    for (std::size_t k = 0; k < session.checks.size(); ++k) {
        if (only && *only != k) continue;
        session.verdict.reset();
        if (session.checks[k].by_hand) {
            all.push_back({session.checks[k], {}, {}, {}});
            continue;
        }
        const auto start = processor_time();
        const RunRecord record = runtime.run_code("_verdict(" + std::to_string(k) + ")", session.checks[k].id);
        TriedCheck& one = all.emplace_back();
        one.check = session.checks[k];
        one.seconds = std::chrono::duration<double>(processor_time() - start).count();
        if (session.verdict && !record.error) {
            one.share = session.verdict->share;
            one.message = shortened_message(session.verdict->message);
            one.for_instructor = shortened_message(session.verdict->for_instructor);
        } else {
            one.message =
                record.error ? shortened_message(with_place(*record.error)) : Message("the check returned no result");
        }
    }
    return all;
}

constexpr std::uint64_t kMostVerdicts = 4u << 20;  // bytes of what the checks say of one submission

RunOptions options_of_checks(const ChecksJob& job) {
    RunOptions options;
    options.time = TimeLimits{std::chrono::milliseconds(job.time_ms), job.clock_multiple};
    return options;
}

/// The checks that files declare.
class ReadChecks {
  public:
    ReadChecks(const ChecksJob& job, const SubmissionToJudge* submission)
        : runtime_(options_of_checks(job), renderer_) {
        session_.hidden_folder = job.hidden_folder;
        if (submission != nullptr) hand_over(*submission);
        for (const auto functions : {check_declarations, check_functions, check_source_functions,
                                     check_record_functions, verdict_function, record_function})
            runtime_.add_functions(functions(), session_);
        for (const CheckFile& file : job.files) {
            session_.visible_file = file.visible;
            const RunRecord record = runtime_.run_code(file.source, file.name);
            if (!record.error) continue;
            error_ = with_place(*record.error);
            return;
        }
    }

    /// A sentence, when a file cannot be read.
    const std::optional<Message>& error() const { return error_; }

    std::vector<TriedCheck> tried(std::optional<std::size_t> only) { return verdicts(runtime_, session_, only); }

    /// The checks as they are declared, the rigs, and the records that are wanted of these.
    CheckResults listed(const std::vector<WantedRecord>& records) {
        CheckResults results;
        for (const auto& [name, rig] : session_.rigs) results.rigs.push_back(name);
        for (const WantedRecord& wanted : records) {
            const RunRecord record = runtime_.run_code(
                fmt::format("_record(\"{}\", {}, {})", wanted.rig, wanted.specimen, wanted.seed), wanted.rig);
            if (record.error) {
                results.error = with_place(*record.error);
                return results;
            }
            results.records.push_back(std::move(session_.record));
        }
        for (const DeclaredCheck& check : session_.checks) results.checks.push_back({check, {}, {}, {}});
        return results;
    }

  private:
    void hand_over(const SubmissionToJudge& submission) {
        session_.specimens = submission.specimens;
        session_.runs = submission.work.runs;
        session_.findings = submission.work.findings;
        session_.source = submission.work.source;
        if (const auto& change = submission.work.change) session_.change = {change->name, change->factor};
    }

    CheckSession session_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
    std::optional<Message> error_;
};

/// In a copy of this process.
JudgedSubmission judged_in_a_copy(const ChecksJob& job, const SubmissionToJudge& submission) {
    GuardLimits limits;
    limits.time = {std::chrono::milliseconds(job.most_ms), job.clock_multiple};
    limits.memory_bytes = ProcessLimits().memory_bytes;
    limits.output_bytes = kMostVerdicts;
    limits.one_task = false;  // checks read files of several kinds
    const auto start = std::chrono::steady_clock::now();
    const ChildResult copy = run_guarded(
        [&] {
            ::setenv("DYNLAB_HOME", submission.home.c_str(), 1);
            JudgedSubmission judged;
            ReadChecks checks(job, &submission);
            if (checks.error())
                judged.reason = *checks.error();
            else
                judged.checks = checks.tried(job.only);
            return cbor_of(judged);
        },
        limits);
    JudgedSubmission judged;
    judged.reason = reason_of_end(copy, limits.time);
    try {
        if (judged.reason.empty()) judged = from_cbor<JudgedSubmission>(copy.output, boxed_limits(kMostVerdicts));
    } catch (const ValueError&) {
        judged.reason = Message("the result of the run cannot be read");
    }
    judged.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return judged;
}

}  // namespace

CheckResults try_checks(const ChecksJob& job) {
    CheckResults results;
    if (job.submissions.empty()) {
        confine_process({});
        ReadChecks checks(job, nullptr);
        if (!checks.error()) return checks.listed(job.records);
        results.error = checks.error();
        return results;
    }
    limit_process({});
    hide_memory();
    for (const SubmissionToJudge& submission : job.submissions)
        results.judged.push_back(judged_in_a_copy(job, submission));
    return results;
}

}  // namespace dynlab::inline course
