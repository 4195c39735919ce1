#include "course/checks/check_run.h"

#include <fmt/format.h>

#include <chrono>

#include "course/checks/check_functions.h"
#include "course/checks/check_records.h"
#include "course/checks/check_session.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "platform/confinement.h"
#include "scripting/runtime/runtime.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kLongestMessage = 400;

std::string shortened_message(std::string message) {
    message = replaced(message, "\n", " ");
    return message.size() > kLongestMessage ? message.substr(0, kLongestMessage) + " ..." : message;
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
        const auto start = std::chrono::steady_clock::now();
        const RunRecord record = runtime.run_code("_verdict(" + std::to_string(k) + ")", session.checks[k].id);
        TriedCheck& one = all.emplace_back();
        one.check = session.checks[k];
        one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (session.verdict && !record.error) {
            one.share = session.verdict->share;
            one.message = shortened_message(session.verdict->message);
            one.for_instructor = shortened_message(session.verdict->for_instructor);
        } else {
            one.message = record.error ? shortened_message(record.error->message) : "it gave no verdict";
        }
    }
    return all;
}

/// Says whose work is judged from now on.
void hand_over(const CheckedSubmission& submission, CheckSession& session) {
    session.runs = submission.runs;
    session.findings = submission.findings;
    session.source = submission.source;
    session.change.reset();
    if (submission.change) session.change = {submission.change->name, submission.change->factor};
}

}  // namespace

CheckResults try_checks(const ChecksJob& job) {
    confine_process({});
    CheckSession session;
    session.hidden_folder = job.hidden_folder;
    session.specimens = job.specimens;
    if (job.submission) hand_over(*job.submission, session);
    GnuplotRenderer renderer;
    RunOptions options;
    options.time_limit = std::chrono::milliseconds(job.time_ms);
    Runtime runtime(options, renderer);
    runtime.set_service(&session);
    for (const auto functions : {check_declarations, check_functions, check_source_functions, check_record_functions,
                                 verdict_function, record_function})
        runtime.add_functions(functions());
    CheckResults results;
    for (const CheckFile& file : job.files) {
        session.visible_file = file.visible;
        const RunRecord record = runtime.run_code(file.source, file.name);
        if (!record.error) continue;
        results.error = record.error->message;
        return results;
    }
    for (const auto& [name, rig] : session.rigs) results.rigs.push_back(name);
    for (const WantedRecord& wanted : job.records) {
        const RunRecord record = runtime.run_code(
            fmt::format("_record(\"{}\", {}, {})", wanted.rig, wanted.specimen, wanted.seed), wanted.rig);
        if (record.error) {
            results.error = record.error->message;
            return results;
        }
        results.records.push_back(std::move(session.record));
    }
    if (job.submission) {
        results.checks = verdicts(runtime, session, job.only);
        for (const CheckedSubmission& submission : job.further) {
            hand_over(submission, session);
            results.further.push_back(verdicts(runtime, session, job.only));
        }
    } else {
        for (const DeclaredCheck& check : session.checks) results.checks.push_back({check, {}, {}, {}});
    }
    return results;
}

}  // namespace dynlab::inline course
