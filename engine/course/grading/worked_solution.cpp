// The reference solution, on which GradingRules tests its checks before grading.
#include <algorithm>

#include "course/grading/cached_stages.h"
#include "course/grading/grading_rules.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "platform/hash.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr double kMuchOfTheTime = 0.5;  // that a reference solution uses

/// The message that the reference solution fails a check. It names the error of a run that the check depends on, if the
/// error is the reason for missing answers.
Message complaint_about(const CheckDescription& check, const std::map<std::string, GradedRun>& runs,
                        const Message& said) {
    for (const std::string& name : {std::string(kMainRun), check.rerun}) {
        const auto run = runs.find(name);
        if (run == runs.end() || !run->second.error) continue;
        const Message error_reason = shortened_error(*run->second.error);
        if (name == kMainRun)
            return Message(
                "the check \"{}\" is left ungraded, because the run of the reference solution stopped: {}. The check "
                "reports: {}",
                check.id, error_reason, said);
        return Message(
            "the check \"{}\" is left ungraded, because the run of the reference solution on {} stopped: {}. The check "
            "reports: {}",
            check.id, name, error_reason, said);
    }
    return Message("the check \"{}\" is left ungraded, because the reference solution does not pass it: {}", check.id,
                   said);
}

/// Whether nothing stood in the way that may be gone another time, such as a busy machine.
bool went_well(const CheckedSubmission& work) {
    const auto failed = [](const auto& run) { return run.second.error.has_value(); };
    const auto fails = [](const Issue& issue) { return issue.id == kDocumentFails; };
    return std::ranges::none_of(work.runs, failed) && std::ranges::none_of(work.findings, fails);
}

}  // namespace

std::vector<Message> GradingRules::try_solution(const fs::path& memory, bool run_again) {
    const TemporaryFolder work;
    fs::copy_file(setup_.lesson.script(), work.path() / "analysis.lua");
    if (const fs::path report = setup_.lesson.report("en"); fs::exists(report))
        fs::copy_file(report, work.path() / "report.md");
    std::string log, content = sha256_of_file(work.path() / "analysis.lua");
    if (fs::exists(work.path() / "report.md")) content += sha256_of_file(work.path() / "report.md");
    const std::string fingerprint = run_fingerprint(content, {});
    std::optional<CachedRuns> kept = run_again || memory.empty() ? std::nullopt : read_cached_runs(memory, fingerprint);
    if (!kept) {
        kept = CachedRuns{fingerprint, work_in(work.path(), {}, log), {}, ""};
        if (!memory.empty() && went_well(kept->work)) write_cached_runs(memory, *kept, CachedTimes::kYes);
    }
    for (const auto& [name, run] : kept->work.runs) solution_seconds_[name] = run.seconds;
    std::vector<Message> complaints;
    const std::map<std::string, GradedRun> runs = kept->work.runs;
    const Grade solution = grade_all({{"solution", std::move(kept->work), {}, log}}).front();
    if (!solution.error_reason.empty())
        complaints.push_back(Message("the reference solution stopped: {}", solution.error_reason));
    for (std::size_t k = 0; k < solution.checks.size(); ++k) {
        const CheckGrade& check = solution.checks[k];
        if (check.by_hand || (check.graded && check.earned == check.points)) continue;
        broken_.insert(check.id);
        const Message& reported = check.for_instructor.empty() ? check.message : check.for_instructor;
        complaints.push_back(
            complaint_about(checks_.at(k), runs, reported.empty() ? Message("the check returned false") : reported));
    }
    return complaints;
}

std::optional<Message> GradingRules::note_on_time() const {
    const double max_seconds = std::chrono::duration<double>(setup_.time.processor).count();
    double longest = 0;
    for (const auto& [name, seconds] : solution_seconds_) longest = std::max(longest, seconds);
    if (longest <= kMuchOfTheTime * max_seconds) return {};
    return Message(
        "a run of the reference solution uses {} s of processor time, and submissions may use {} s ({} times as much). "
        "Increase --timeout, or students with slower scripts lose marks",
        decimals(longest, 1), significant(max_seconds, 6), decimals(max_seconds / longest, 1));
}

}  // namespace dynlab::inline course
