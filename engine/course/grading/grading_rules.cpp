#include "course/grading/grading_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "base/reader.h"
#include "course/checks/check_descriptions.h"
#include "course/grading/cached_stages.h"
#include "course/issues/document_issues.h"
#include "course/issues/issues_report.h"
#include "course/sandbox_jobs/sandbox_messages.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "data_io/values/json_values.h"
#include "numerics/plants/plant_catalog.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr auto kCheckTime = std::chrono::milliseconds(10000);     // of one check
constexpr auto kSingleTime = std::chrono::milliseconds(60000);    // of all checks, when each runs in its own sandbox
constexpr auto kDocumentTime = std::chrono::milliseconds(15000);  // beyond the script's own
constexpr int kClockMultiple = 20;  // a script cannot wait: only a busy machine makes its run last
constexpr std::uint64_t kScriptMemory = 1ull << 30;
constexpr std::uintmax_t kMaxCheckedSourceBytes = 1u << 20;  // bytes of a script that checks may read

/// The lesson's template where it demands something, else its report.
std::string standard_for(const Lesson& lesson, const PercentScript& script) {
    const DocumentStandard named = standard_of(script.header.template_name);
    const fs::path report = lesson.report("en");
    const bool demands = named.rules.pages || !named.rules.sections.empty();
    return demands || !fs::exists(report) ? script.header.template_name : report.string();
}

/// One of the cores that sandboxes share; the constructor waits for it.
class TakenCore {
  public:
    explicit TakenCore(std::counting_semaphore<>& free) : free_(free) { free_.acquire(); }
    ~TakenCore() { free_.release(); }
    TakenCore(const TakenCore&) = delete;
    TakenCore& operator=(const TakenCore&) = delete;

  private:
    std::counting_semaphore<>& free_;
};

std::string hash_of_parts(const std::vector<std::string>& parts) {
    Sha256 hash;
    for (const std::string& part : parts) hash.add(std::to_string(part.size()) + ":").add(part);
    return hash.hex();
}

[[noreturn]] void refuse_rerun(const std::string& check, const std::string& rerun) {
    std::vector<std::string> names;
    for (const Plant& plant : plant_catalog()) names.push_back(plant.name);
    throw EnvironmentError(
        "the check \"{}\" requests a rerun on the unknown data set \"{}\". Use \"seed\" (another seed), {}, a plant "
        "that the checks declare, or rerun/NAME.csv in the folder of the checks",
        check, rerun, listed(names));
}

}  // namespace

GradingRules::GradingRules(GradingSetup setup)
    : setup_(std::move(setup)), free_cores_(std::make_unique<std::counting_semaphore<>>(std::max(1, setup_.jobs))) {
    const PercentScript lesson = read_percent_script(setup_.lesson.script());
    lesson_ = lesson.header.lesson;
    seed_ = lesson.header.seed;
    standard_ = standard_for(setup_.lesson, lesson);
    answers_ = lesson.header.answers;
    bring_lesson_data();
    read_checks();
    make_data_sets();
}

void GradingRules::read_checks() {
    const fs::path own = setup_.lesson.folder / "checks.lua";
    if (!fs::is_regular_file(own)) throw EnvironmentError("lesson {} has no checks.lua", setup_.lesson.slug);
    files_.push_back({"checks.lua", read_text(own), true});
    if (setup_.more_checks) {
        std::vector<fs::path> more;
        if (!fs::is_directory(*setup_.more_checks))
            throw EnvironmentError("folder not found: '{}'", setup_.more_checks->string());
        for (const auto& entry : fs::directory_iterator(*setup_.more_checks))
            if (entry.path().extension() == ".lua") more.push_back(entry.path());
        if (more.empty())
            throw EnvironmentError("the folder '{}' contains no checks (files *.lua)", setup_.more_checks->string());
        std::ranges::sort(more);
        for (const fs::path& file : more) files_.push_back({file.filename().string(), read_text(file), false});
    }
    const SandboxResult<CheckResults> read = listed();
    if (!read.output) throw EnvironmentError("the checks cannot be read: {}", read.reason);
    if (read.output->error) throw EnvironmentError(*read.output->error);
    for (const EvaluatedCheck& one : read.output->checks) checks_.push_back(one.check);
    declared_plants_ = read.output->plants;
    if (checks_.empty())
        throw EnvironmentError("lesson {} declares no checks; declare at least one check in its checks.lua",
                               setup_.lesson.slug);
    for (const CheckDescription& check : checks_) {
        const std::string& rerun = check.rerun;
        document_ = document_ || check.document;
        if (check.document && !fs::exists(setup_.lesson.report("en")))
            throw EnvironmentError(
                "the check \"{}\" examines the document, but lesson {} has no document: document = true requires "
                "report.en.md in the folder of the lesson",
                check.id, setup_.lesson.slug);
        if (rerun.empty()) continue;
        const bool declared = std::ranges::find(declared_plants_, rerun) != declared_plants_.end();
        if (rerun != kOtherSeedRun && !find_plant(rerun) && !declared && !own_data_set("rerun", rerun))
            refuse_rerun(check.id, rerun);
        reruns_.insert(rerun);
    }
}

fs::path GradingRules::add_home(Sandbox& sandbox, const std::string& run, const GroupSeed& group_seed) const {
    const bool own = run != kMainRun && run != kOtherSeedRun;
    const fs::path data = own ? data_sets_.path() / run / "data" : data_of(group_seed);
    return sandbox.add(data, "/box/home/data").parent_path();
}

/// One run of the script in its own sandbox, without the data sets and files of other runs.
GradedRun GradingRules::run(const std::string& name, const fs::path& folder, const GroupSeed& group_seed,
                            std::string& log) const {
    Sandbox sandbox(setup_.isolation);
    sandbox.set_environment("DYNLAB_HOME", add_home(sandbox, name, group_seed).string());
    RunJob job;
    job.script = sandbox.add(folder, "/box/submission") / "analysis.lua";
    job.seed = name == kOtherSeedRun ? drawn("seed") : seed_;
    job.answers = answers_;
    job.memory_bytes = kScriptMemory;
    job.time_ms = setup_.time.processor.count();
    job.recalls = setup_.call_memory.has_value();
    if (job.recalls)
        sandbox.set_environment("XDG_CACHE_HOME",
                                sandbox.add_writable(*setup_.call_memory, "/box/caches/dynlab").parent_path());
    const TimeLimits limits{setup_.time.processor, kClockMultiple};
    const auto result = run_in_sandbox(sandbox, setup_.program, job, limits, kMaxGradedRunBytes);
    if (result.waited)
        throw EnvironmentError(
            "the machine was too busy: the script had not used its {} s of processor time after {} s. Grade the "
            "submission again when the machine is less busy, or with fewer --jobs",
            limits.seconds(TimeLimit::kProcessor), limits.seconds(TimeLimit::kClock));
    GradedRun run = result.output.value_or(GradedRun());
    if (!result.output) run.error = Message("The script was stopped: {}.", result.reason);
    const auto solution = solution_seconds_.find(name);
    log += fmt::format(
        "run {}: {:.3f} s of processor time{}, {:.3f} s elapsed time in its sandbox\n{}", name, run.seconds,
        solution == solution_seconds_.end() ? "" : fmt::format(" (reference solution: {:.3f} s)", solution->second),
        result.seconds, run.error ? "  " + message_text(shortened_error(*run.error)) + "\n" : "");
    return run;
}

/// The run on the official data and the reruns, by name, in parallel on the free cores.
std::map<std::string, GradedRun> GradingRules::runs(const fs::path& folder, const GroupSeed& group_seed,
                                                    std::string& log) const {
    std::vector<std::string> names = {kMainRun};
    names.insert(names.end(), reruns_.begin(), reruns_.end());
    std::vector<std::string> logs(names.size());
    std::vector<std::future<GradedRun>> results;
    for (std::size_t k = 0; k < names.size(); ++k)
        results.push_back(std::async(std::launch::async, [&, k] {
            const TakenCore core(*free_cores_);
            return run(names[k], folder, group_seed, logs[k]);
        }));
    std::map<std::string, GradedRun> all;
    for (std::size_t k = 0; k < names.size(); ++k) all[names[k]] = results[k].get();
    for (const std::string& lines : logs) log += lines;
    return all;
}

Issues GradingRules::findings(const fs::path& folder, const GroupSeed& group_seed) const {
    const TakenCore core(*free_cores_);
    Sandbox sandbox(setup_.isolation);
    sandbox.add_document_home(data_of(group_seed));
    const fs::path inside = sandbox.add(folder, "/box/submission"), program = sandbox.add_program(setup_.program);
    const bool file = standard_.ends_with(".md");
    const std::string standard = file ? sandbox.add(standard_, "/box/standard/report.md").string() : standard_;
    Sandbox::Limits limits;
    limits.time = setup_.time;
    limits.time.processor += kDocumentTime;
    const ChildResult child =
        sandbox.run({program.string(), "check", "--json", "--document-only", "--template", standard, inside.string()},
                    {}, "", limits);
    try {
        return issues_from_json(child.output).findings;
    } catch (const EnvironmentError&) {
        return {{kDocumentFails, Severity::kRule, 0, "",
                 child.timed_out ? Message("The report cannot be created: {}.", reason_of_end(child, limits.time))
                                 : Message("The report cannot be created."),
                 Message()}};
    }
}

SandboxResult<CheckResults> GradingRules::listed(std::vector<RequestedDataSet> data_sets) const {
    const TakenCore core(*free_cores_);
    Sandbox sandbox(setup_.isolation);
    sandbox.set_environment("DYNLAB_HOME", add_home(sandbox, kMainRun, {}).string());
    ChecksJob job;
    job.files = files_;
    job.time_ms = kCheckTime.count();
    job.clock_multiple = setup_.time.clock_multiple;
    job.data_sets = std::move(data_sets);
    return run_in_sandbox(sandbox, setup_.program, job, {kSingleTime, setup_.time.clock_multiple});
}

/// Each may take `max_time`.
SandboxResult<CheckResults> GradingRules::checked(const std::vector<Work>& works, std::chrono::milliseconds max_time,
                                                  std::optional<std::size_t> only) const {
    const TakenCore core(*free_cores_);
    Sandbox sandbox(setup_.isolation);
    ChecksJob job;
    job.files = files_;
    job.hidden_folder = sandbox.add(data_sets_.path() / kHiddenDataSets, "/box/hidden");
    job.time_ms = kCheckTime.count();
    job.most_ms = max_time.count();
    job.clock_multiple = setup_.time.clock_multiple;
    job.only = only;
    std::map<GroupSeed, fs::path> homes;
    for (const Work& work : works) {
        const auto [home, fresh] = homes.try_emplace(work.group_seed);
        if (fresh)
            home->second =
                sandbox.add(data_of(work.group_seed), fmt::format("/box/home-{}/data", homes.size())).parent_path();
        job.submissions.push_back({work.submission, home->second, variants_of(work.group_seed)});
    }
    sandbox.set_environment("DYNLAB_HOME", job.submissions.front().home.string());
    return run_in_sandbox(sandbox, setup_.program, job,
                          {max_time * static_cast<int>(works.size()), setup_.time.clock_multiple});
}

std::vector<std::vector<EvaluatedCheck>> GradingRules::evaluated(
    const std::vector<CheckedSubmission>& submissions) const {
    if (submissions.empty()) return {};
    std::vector<Work> works;
    for (const CheckedSubmission& submission : submissions) works.push_back({"", submission, {}, ""});
    auto result = checked(works, kSingleTime);
    if (!result.output) throw EnvironmentError("the checks did not finish: {}", result.reason);
    std::vector<std::vector<EvaluatedCheck>> all;
    for (GradedSubmission& submission_result : result.output->judged) {
        if (!submission_result.reason.empty())
            throw EnvironmentError("the checks did not finish: {}", submission_result.reason);
        all.push_back(std::move(submission_result.checks));
    }
    return all;
}

/// Runs each check in its own sandbox. Only the checks that do not finish there have no result.
std::vector<GradingRules::CheckAttempt> GradingRules::separate_check_attempts(const Work& work) const {
    const Message unreadable_result = Message("the result of the run cannot be read");
    std::vector<CheckAttempt> all;
    for (std::size_t k = 0; k < checks_.size(); ++k) {
        const auto alone = checked({work}, kSingleTime / static_cast<int>(checks_.size()), k);
        const bool answered = alone.output && alone.output->judged.size() == 1;
        if (!answered)
            all.push_back({{}, alone.output ? unreadable_result : alone.reason});
        else if (const GradedSubmission& submission_result = alone.output->judged.front();
                 submission_result.checks.size() == 1)
            all.push_back({submission_result.checks.front(), {}});
        else
            all.push_back({{}, submission_result.reason.empty() ? unreadable_result : submission_result.reason});
    }
    return all;
}

/// Answers that crash or block one check also stop the other checks of their submission; each check is then run
/// separately.
std::vector<std::vector<GradingRules::CheckAttempt>> GradingRules::check_attempts(std::vector<Work>& works) const {
    const SandboxResult<CheckResults> together = checked(works, kSingleTime);
    const bool answered = together.output && together.output->judged.size() == works.size();
    std::vector<std::vector<CheckAttempt>> all(works.size());
    for (std::size_t i = 0; i < works.size(); ++i) {
        GradedSubmission submission_result{{}, together.reason, together.seconds};
        if (answered) submission_result = together.output->judged[i];
        works[i].log +=
            fmt::format("checks: {:.3f} s in the sandbox{}\n", submission_result.seconds,
                        submission_result.reason.empty() ? "" : "; " + message_text(submission_result.reason));
        if (submission_result.checks.size() != checks_.size()) {
            all[i] = separate_check_attempts(works[i]);
            continue;
        }
        for (EvaluatedCheck& one : submission_result.checks) all[i].push_back({std::move(one), {}});
    }
    return all;
}

Grade GradingRules::unreadable(const std::string& name, const Message& error_reason) const {
    Grade grade = ungraded(name);
    grade.error_reason = error_reason;
    grade.unreadable = true;
    for (CheckGrade& check : grade.checks) check.graded = false;
    return grade;
}

/// The checks as they are declared.
Grade GradingRules::ungraded(const std::string& name) const {
    Grade grade;
    grade.submission = name;
    grade.lesson = setup_.lesson.slug;
    grade.isolation = isolation_name(setup_.isolation);
    for (const CheckDescription& check : checks_) {
        CheckGrade one;
        one.id = check.id;
        one.about = Message::verbatim(check.about);
        one.hint = Message::verbatim(check.hint);
        one.points = check.points;
        one.visible = check.visible;
        one.by_hand = check.by_hand;
        one.rubric = check.rubric;
        one.graded = !broken_.contains(one.id) && !check.by_hand;
        grade.checks.push_back(std::move(one));
    }
    return grade;
}

CheckedSubmission GradingRules::work_in(const fs::path& folder, const GroupSeed& group_seed, std::string& log,
                                        bool of_notebook) const {
    CheckedSubmission work;
    work.runs = runs(folder, group_seed, log);
    if (document_) work.findings = findings(folder, group_seed);
    const fs::path script = folder / "analysis.lua";
    std::error_code error;
    if (fs::file_size(script, error) <= kMaxCheckedSourceBytes && !error) work.source = read_file(script);
    for (auto& [name, run] : work.runs)
        if (of_notebook && run.error)
            run.error = with_places_in_notebook(*run.error, "analysis.lua", "analysis.ipynb", work.source);
    return work;
}

Grade GradingRules::grade(const std::string& name, const fs::path& folder, const GroupSeed& group_seed) const {
    std::string log;
    CheckedSubmission work = work_in(folder, group_seed, log);
    return grade_all({{name, std::move(work), group_seed, std::move(log)}}).front();
}

std::vector<Grade> GradingRules::grade_all(std::vector<Work> works) const {
    std::vector<Grade> grades;
    if (works.empty()) return grades;
    const std::vector<std::vector<CheckAttempt>> found = check_attempts(works);
    for (std::size_t i = 0; i < works.size(); ++i) grades.push_back(grade_of(std::move(works[i]), found[i]));
    return grades;
}

Grade GradingRules::grade_of(Work&& work, const std::vector<CheckAttempt>& found) const {
    Grade grade = ungraded(work.name);
    grade.log = std::move(work.log);
    const GradedRun& main = work.submission.runs.at(kMainRun);
    if (!main.lesson.empty() && !lesson_.empty() && main.lesson != lesson_)
        return unreadable(work.name, Message("This is the script of lesson {}, not of {}.", main.lesson, lesson_));
    grade.began = main.began;
    grade.silent = main.answers.empty();
    if (main.error) grade.error_reason = shortened_error(*main.error);
    grade.printed = main.printed;
    for (std::size_t k = 0; k < grade.checks.size(); ++k) {
        CheckGrade& check = grade.checks[k];
        const auto& [outcome, reason] = found.at(k);
        if (check.by_hand) continue;
        check.for_instructor = outcome ? outcome->for_instructor : reason;
        if (!check.for_instructor.empty())
            grade.log += fmt::format("check {}: {}\n", check.id, message_text(check.for_instructor));
        if (!outcome) {
            check.graded = false;
            check.message = Message("The check could not be run on these answers.");
            continue;
        }
        check.earned = check.points * outcome->share.value_or(0);
        check.message = outcome->message;
        if (!check.visible && !check.message.empty() && check.for_instructor.empty())
            grade.log += fmt::format("check {}: {}\n", check.id, message_text(check.message));
    }
    if (!grade.printed.empty()) grade.log += "\nprinted by the script, at its end:\n" + grade.printed;
    return grade;
}

std::string GradingRules::fingerprint(const std::string& content_hash, const GroupSeed& group_seed) const {
    return hash_of_parts(
        {run_fingerprint(content_hash, group_seed), json_of(files_), fmt::format("{}", fmt::join(broken_, " "))});
}

std::string GradingRules::run_fingerprint(const std::string& content_hash, const GroupSeed& group_seed) const {
    return hash_of_parts({content_hash, program_identity(), setup_.lesson.slug, sha256_of_file(setup_.lesson.script()),
                          setup_.secret, std::to_string(setup_.time.processor.count()),
                          isolation_name(setup_.isolation), fmt::format("{}", fmt::join(reruns_, " ")),
                          document_ ? standard_ : "", own_data_sets_,
                          declared_plants_.empty() ? "" : json_of(files_),  // which create data sets
                          group_seed ? std::to_string(*group_seed) : ""});
}

}  // namespace dynlab::inline course
