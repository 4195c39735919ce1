#include "course/grading/check_run.h"

#include "course/grading/check_functions.h"
#include "course/grading/check_records.h"
#include "course/grading/check_session.h"
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
        const RunRecord record = runtime.run_code("_verdict(" + std::to_string(k) + ")", session.checks[k].id);
        TriedCheck& one = all.emplace_back();
        one.check = session.checks[k];
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

}  // namespace

CheckResults try_checks(const ChecksJob& job) {
    confine_process({});
    CheckSession session;
    session.hidden_folder = job.hidden_folder;
    session.specimens = job.specimens;
    if (job.submission) {
        session.runs = job.submission->runs;
        session.findings = job.submission->findings;
    }
    GnuplotRenderer renderer;
    RunOptions options;
    options.time_limit = std::chrono::milliseconds(job.time_ms);
    Runtime runtime(options, renderer);
    runtime.set_service(&session);
    runtime.add_functions(check_functions());
    runtime.add_functions(check_record_functions());
    runtime.add_functions(verdict_function());
    CheckResults results;
    for (const CheckFile& file : job.files) {
        session.visible_file = file.visible;
        const RunRecord record = runtime.run_code(file.source, file.name);
        if (!record.error) continue;
        results.error = record.error->message;
        return results;
    }
    if (job.submission) {
        results.checks = verdicts(runtime, session, job.only);
    } else {
        for (const DeclaredCheck& check : session.checks) results.checks.push_back({check, {}, {}, {}});
    }
    return results;
}

}  // namespace dynlab::inline course
