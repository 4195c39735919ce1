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

using nlohmann::json;

constexpr std::size_t kLongestMessage = 400;

std::string shortened_message(std::string message) {
    message = replaced(message, "\n", " ");
    return message.size() > kLongestMessage ? message.substr(0, kLongestMessage) + " ..." : message;
}

json description(const DeclaredCheck& check) {
    return {{"id", check.id},           {"about", check.about}, {"hint", check.hint},        {"points", check.points},
            {"visible", check.visible}, {"rerun", check.rerun}, {"document", check.document}};
}

/// Tries every check, or the only one wanted, each with a time limit of its own.
json verdicts(Runtime& runtime, CheckSession& session, const json& only) {
    json all = json::array();
    for (std::size_t k = 0; k < session.checks.size(); ++k) {
        if (only.is_number() && only != k) continue;
        session.verdict.reset();
        const RunRecord record = runtime.run_code("_verdict(" + std::to_string(k) + ")", session.checks[k].id);
        json one = description(session.checks[k]);
        if (session.verdict && !record.error) {
            one["share"] = session.verdict->share;
            one["message"] = shortened_message(session.verdict->message);
            one["for_instructor"] = shortened_message(session.verdict->for_instructor);
        } else {
            one["share"] = nullptr;
            one["message"] = record.error ? shortened_message(record.error->message) : "it gave no verdict";
        }
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

json try_checks(const json& job) {
    confine_process({});
    CheckSession session;
    session.hidden_folder = job.at("hidden_folder").get<std::string>();
    session.specimens = job.at("specimens").get<std::map<std::string, Specimens>>();
    const bool tries = !job.at("submission").is_null();
    if (tries) {
        session.runs = job.at("submission").at("runs");
        session.findings = job.at("submission").at("findings");
    }
    GnuplotRenderer renderer;
    RunOptions options;
    options.time_limit = std::chrono::milliseconds(job.at("time_ms").get<long>());
    Runtime runtime(options, renderer);
    runtime.set_service(&session);
    runtime.add_functions(check_functions());
    runtime.add_functions(check_record_functions());
    runtime.add_functions(verdict_function());
    for (const json& file : job.at("files")) {
        session.visible_file = file.at("visible");
        const RunRecord record = runtime.run_code(file.at("source"), file.at("name"));
        if (record.error) return {{"error", record.error->message}};
    }
    if (tries) return {{"checks", verdicts(runtime, session, job.at("only"))}};
    json listed = json::array();
    for (const DeclaredCheck& check : session.checks) listed.push_back(description(check));
    return {{"checks", std::move(listed)}};
}

}  // namespace dynlab::inline course
