#include "course/checks/read_checks.h"

#include <fmt/format.h>

#include <chrono>

#include "course/checks/check_data.h"
#include "course/checks/check_functions.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "documents/text_lines.h"
#include "platform/hash.h"
#include "platform/time_limits.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMaxMessageLength = 400;

Message shortened_message(const Message& message) {
    return with_changed_text(message, [](const std::string& text) {
        const std::string line = replaced(text, "\n", " ");
        return line.size() > kMaxMessageLength ? line.substr(0, kMaxMessageLength) + " ..." : line;
    });
}

/// Runs every check, or only the requested one. Each check has a separate time limit.
std::vector<EvaluatedCheck> evaluate_checks(Runtime& runtime, CheckSession& session, std::optional<std::size_t> only) {
    std::vector<EvaluatedCheck> all;
    for (std::size_t k = 0; k < session.checks.size(); ++k) {
        if (only && *only != k) continue;
        session.outcome.reset();
        if (session.checks[k].by_hand) {
            all.push_back({session.checks[k], {}, {}, {}});
            continue;
        }
        const auto start = processor_time();
        const RunRecord record = runtime.run_code("_verdict(" + std::to_string(k) + ")", session.checks[k].id);
        EvaluatedCheck& one = all.emplace_back();
        one.check = session.checks[k];
        one.seconds = std::chrono::duration<double>(processor_time() - start).count();
        if (session.outcome && !record.error) {
            one.share = session.outcome->share;
            one.message = shortened_message(session.outcome->message);
            one.for_instructor = shortened_message(session.outcome->for_instructor);
        } else {
            one.message =
                record.error ? shortened_message(with_place(*record.error)) : Message("the check returned no result");
        }
    }
    return all;
}

RunOptions options_of_checks(const ChecksJob& job) {
    RunOptions options;
    options.time = TimeLimits{std::chrono::milliseconds(job.time_ms), job.clock_multiple};
    return options;
}

}  // namespace

ReadChecks::ReadChecks(const ChecksJob& job, const SubmissionToGrade* submission)
    : runtime_(options_of_checks(job), renderer_) {
    session_.hidden_folder = job.hidden_folder;
    if (submission != nullptr) hand_over(*submission);
    for (const auto functions : {check_declarations, check_functions, check_source_functions, check_data_functions,
                                 outcome_function, data_function})
        runtime_.add_functions(functions(), session_);
    for (const CheckFile& file : job.files) {
        session_.visible_file = file.visible;
        const RunRecord record = runtime_.run_code(file.source, file.name);
        if (!record.error) continue;
        error_ = with_place(*record.error);
        return;
    }
}

std::vector<EvaluatedCheck> ReadChecks::evaluated(std::optional<std::size_t> only) {
    return evaluate_checks(runtime_, session_, only);
}

CheckResults ReadChecks::listed(const std::vector<RequestedDataSet>& data_sets) {
    CheckResults results;
    for (const auto& [name, plant] : session_.plants) results.plants.push_back(name);
    for (const RequestedDataSet& requested : data_sets) {
        const RunRecord record = runtime_.run_code(
            fmt::format("_record(\"{}\", {}, {})", requested.plant, requested.variant, requested.seed),
            requested.plant);
        if (record.error) {
            results.error = with_place(*record.error);
            return results;
        }
        results.data_sets.push_back(std::move(session_.simulated_data));
    }
    for (const DeclaredCheck& check : session_.checks) results.checks.push_back({check, {}, {}, {}});
    return results;
}

void ReadChecks::hand_over(const SubmissionToGrade& submission) {
    session_.variants = submission.variants;
    session_.runs = submission.work.runs;
    session_.findings = submission.work.findings;
    session_.source = submission.work.source;
    if (const auto& change = submission.work.change) session_.change = {change->name, change->factor};
}

std::uint32_t drawn_number(const std::string& secret, const std::string& lesson, const std::string& what) {
    const std::string hash = sha256_of(secret + "\n" + lesson + "\n" + what);
    return static_cast<std::uint32_t>(std::stoul(hash.substr(0, 8), nullptr, 16)) | 1u;
}

std::string noise_of(const std::string& data_set, const std::string& run) {
    return (run == kHiddenDataSets ? "noise:" : "noise:rerun:") + data_set;
}

}  // namespace dynlab::inline course
