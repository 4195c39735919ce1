#include "course/grading/check_trial.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <nlohmann/json.hpp>
#include <set>

#include "base/reader.h"
#include "course/grading/feedback.h"
#include "data_io/text_table.h"
#include "documents/solutions.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "platform/terminal/progress.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr double kScaled = 1.5;
constexpr double kSlow = 0.5;  // s: a check that takes longer is reported

bool full(const EvaluatedCheck& check) {
    return check.check.by_hand || check.share == 1;
}

/// Lua files whose names begin so, sorted.
std::vector<fs::path> scripts_in(const fs::path& folder, const std::string& beginning) {
    std::vector<fs::path> found;
    if (!fs::is_directory(folder)) return found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(beginning) && name.ends_with(".lua")) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// The runs of the reference solution with one answer changed. Texts and data sets have no clearly wrong value and are
/// left out.
std::vector<std::pair<std::string, CheckedSubmission>> mutants_of(const CheckedSubmission& solution) {
    std::vector<std::pair<std::string, CheckedSubmission>> mutants;
    for (const auto& [name, answer] : solution.runs.at(kMainRun).answers) {
        if (answer.kind != "text" && answer.kind != "data")
            for (const double factor : {kScaled, -1.0}) {
                if (answer.kind == "truth" && factor < 0) continue;
                CheckedSubmission mutant = solution;
                mutant.change = AnswerChange{name, factor};
                const char* const words = answer.kind == "truth" ? "inverted"
                                          : factor < 0           ? "with the opposite sign"
                                                                 : "1.5 times as large";
                mutants.emplace_back(fmt::format("{} {}", name, words), std::move(mutant));
            }
        CheckedSubmission without = solution;
        for (auto& [run, made] : without.runs) made.answers.erase(name);
        mutants.emplace_back(name + " left out", std::move(without));
    }
    return mutants;
}

/// All numbers of a file of checks, without those in comments and texts.
std::set<double> numbers_of_checks(const std::string& checks) {
    static const RE2 kPassedOver(R"re(--\[\[(?s:.*?)\]\]|--[^\n]*|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')re");
    static const RE2 kNumber(R"((?:^|[^\w.])(\d+(?:\.\d*)?(?:[eE][-+]?\d+)?))");
    std::string source = checks;
    RE2::GlobalReplace(&source, kPassedOver, " ");
    std::set<double> numbers;
    std::string digits;
    for (re2::StringPiece rest = source; RE2::FindAndConsume(&rest, kNumber, &digits);)
        if (const auto value = number_in_cell(digits); value && *value != 0) numbers.insert(*value);
    return numbers;
}

/// The starter with one numeric answer replaced by a number in checks.lua that is close to the solution's value.
std::vector<std::pair<std::string, CheckedSubmission>> typed_in(const CheckedSubmission& starter,
                                                                const CheckedSubmission& solution,
                                                                const std::set<double>& numbers) {
    constexpr double kNear = 0.1;
    std::vector<std::pair<std::string, CheckedSubmission>> typed;
    for (const auto& [name, answer] : solution.runs.at(kMainRun).answers) {
        auto json = nlohmann::json::parse(answer.json, nullptr, false);
        if (!json.is_object() || !json.contains("value") || !json["value"].is_number()) continue;
        const auto value = json["value"].get<double>();
        for (const double number : numbers) {
            if (std::abs(std::abs(value) - number) > kNear * std::abs(value)) continue;
            json["value"] = value < 0 ? -number : number;
            CheckedSubmission one = starter;
            one.runs.at(kMainRun).answers[name] = {answer.kind, json.dump()};
            typed.emplace_back(fmt::format("{} = {}", name, json["value"].get<double>()), std::move(one));
        }
    }
    return typed;
}

/// The runs of a script as a student hands it in.
CheckedSubmission work_of(const GradingRules& rules, const std::string& source) {
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "analysis.lua", source);
    const fs::path report = rules.setup().lesson.report("en");
    if (fs::exists(report)) fs::copy_file(report, folder.path() / "report.md");
    std::string log;
    return rules.work_in(folder.path(), {}, log);
}

std::string points_of_script(const EvaluatedScript& script) {
    double earned = 0, possible = 0;
    for (const EvaluatedCheck& one : script.checks) {
        if (one.check.by_hand) continue;
        earned += one.check.points * one.share.value_or(0);
        possible += one.check.points;
    }
    return fmt::format("{} of {}", points_text(earned), points_text(possible));
}

/// A line for the script and one for each check that it does not pass wholly.
std::string lines_of_script(const EvaluatedScript& script) {
    std::string text = fmt::format("{}: {} points\n", script.name, points_of_script(script));
    if (!script.error_reason.empty()) text += fmt::format("    stopped: {}\n", message_text(script.error_reason));
    for (const EvaluatedCheck& one : script.checks) {
        if (full(one)) continue;
        const std::string reported = message_text(one.for_instructor.empty() ? one.message : one.for_instructor);
        text += fmt::format("    {:<20} {:>3.0f} %  {}\n", one.check.id, 100 * one.share.value_or(0), reported);
    }
    return text;
}

}  // namespace

bool CheckTrial::fails_sometimes(std::size_t check) const {
    const auto fails = [check](const EvaluatedScript& script) { return !full(script.checks.at(check)); };
    return std::any_of(scripts.begin(), scripts.end(), fails) || std::any_of(mutants.begin(), mutants.end(), fails);
}

bool CheckTrial::solution_passes(std::size_t check) const {
    return full(solution.checks.at(check));
}

bool CheckTrial::sound() const {
    return solution.error_reason.empty() && std::all_of(solution.checks.begin(), solution.checks.end(), full);
}

CheckTrial try_checks_of(const GradingSetup& setup, Mutants mutants) {
    const GradingRules rules(setup);
    CheckTrial trial;
    trial.checks = rules.checks();
    const std::string solution = read_text(setup.lesson.script());
    std::vector<std::pair<std::string, std::string>> sources = {
        {"reference solution", solution}, {"starter", without_solutions(solution, setup.lesson.script())}};
    std::vector<fs::path> files;
    for (const char* beginning : {"wrong_", "right_"})
        for (const fs::path& file : scripts_in(setup.lesson.folder, beginning)) files.push_back(file);
    if (setup.more_checks)
        for (const fs::path& file : scripts_in(*setup.more_checks / "try", "")) files.push_back(file);
    for (const fs::path& file : files) sources.emplace_back(file.filename().string(), read_text(file));

    std::vector<CheckedSubmission> submissions;
    std::vector<std::string> names;
    ProgressBar bar("running scripts", sources.size());
    std::vector<std::future<CheckedSubmission>> works;  // the rules know how many may run at once
    for (const auto& [name, source] : sources) {
        works.push_back(std::async(std::launch::async, [&rules, &source = source] { return work_of(rules, source); }));
        names.push_back(name);
    }
    for (std::future<CheckedSubmission>& work : works) {
        submissions.push_back(work.get());
        bar.advance(submissions.size());
    }
    if (mutants == Mutants::kAll)
        for (auto& [name, mutant] : mutants_of(submissions.front())) {
            submissions.push_back(std::move(mutant));
            names.push_back(name);
        }
    const std::size_t changed = submissions.size();
    if (const fs::path visible = setup.lesson.folder / "checks.lua"; fs::exists(visible))
        for (auto& [name, one] : typed_in(submissions[1], submissions.front(), numbers_of_checks(read_text(visible)))) {
            submissions.push_back(std::move(one));
            names.push_back(name);
        }
    const std::vector<std::vector<EvaluatedCheck>> results = rules.evaluated(submissions);
    for (std::size_t k = 0; k < results.size(); ++k) {
        EvaluatedScript script{names[k], submissions[k].runs.at(kMainRun).error.value_or(Message()), results[k]};
        if (k == 0)
            trial.solution = std::move(script);
        else
            (k < sources.size() ? trial.scripts
             : k < changed      ? trial.mutants
                                : trial.typed)
                .push_back(std::move(script));
    }
    return trial;
}

std::string trial_in_words(const CheckTrial& trial) {
    std::string text = lines_of_script(trial.solution);
    for (const EvaluatedScript& script : trial.scripts) text += lines_of_script(script);
    text += fmt::format("\n{} changes of one answer of the reference solution:\n", trial.mutants.size());
    for (const EvaluatedScript& mutant : trial.mutants) {
        std::string failed;
        for (const EvaluatedCheck& one : mutant.checks)
            if (!full(one)) failed += " " + one.check.id;
        text += fmt::format("    {:<44}{}\n", mutant.name, failed.empty() ? " detected by no check" : failed);
    }
    std::string remarks;
    const auto slowest = std::max_element(trial.solution.checks.begin(), trial.solution.checks.end(),
                                          [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    if (slowest != trial.solution.checks.end() && slowest->seconds > kSlow)
        remarks += fmt::format("{}: takes {:.1f} s of each work's grading\n", slowest->check.id, slowest->seconds);
    for (std::size_t k = 0; k < trial.checks.size(); ++k) {
        const CheckDescription& check = trial.checks[k];
        if (check.by_hand)
            remarks += fmt::format("{}: marked by hand\n", check.id);
        else if (!trial.solution_passes(k))
            remarks += fmt::format("{}: the reference solution fails it, so it is not used for grading\n", check.id);
        else if (!trial.fails_sometimes(k))
            remarks += fmt::format("{}: no script fails it\n", check.id);
    }
    return text + (remarks.empty() ? "\nThe reference solution passes every check, and some script fails each check.\n"
                                   : "\n" + remarks);
}

}  // namespace dynlab::inline course
