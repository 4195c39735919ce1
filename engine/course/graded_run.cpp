#include "course/graded_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "documents/error.h"
#include "documents/percent_script.h"
#include "figures/gnuplot_renderer.h"
#include "platform/confinement.h"
#include "platform/guarded_call.h"
#include "scripting/report_language.h"
#include "scripting/runtime.h"

namespace dynlab {
namespace {

using nlohmann::json;

constexpr std::size_t kPrinted = 4000;         // characters that are kept of the end
constexpr std::size_t kMostOutput = 4u << 20;  // of printed text
constexpr int kOpenFiles = 64;
constexpr auto kMargin = std::chrono::milliseconds(300);  // the script's own limit comes first: its answers are kept
constexpr std::uint64_t kMostAnswers = 4ull << 20;

/// The script as the lesson wants it: its own promises of answers do not count.
PercentScript read_for_grading(const json& job) {
    PercentScript script = read_percent_script(job.at("script").get<std::string>());
    script.header.answers.clear();
    for (const json& answer : job.at("answers")) script.header.answers.push_back({answer.at(0), answer.at(1)});
    return script;
}

RunOptions options_of(const json& job, const PercentScript& script) {
    RunOptions options;
    options.seed = job.at("seed");
    options.script_folder = script.file.parent_path();
    options.out_folder = std::filesystem::temp_directory_path();
    options.memory_limit_bytes = job.at("memory_bytes");
    options.output_limit_bytes = kMostOutput;
    options.time_limit = std::chrono::milliseconds(job.at("time_ms").get<long>());
    options.graded = true;
    return options;
}

std::string end_of_printed(const RunRecord& record, const PercentScript& script) {
    std::string printed;
    for (const Cell& cell : script.cells) {
        const auto found = record.outputs.find(cell.id);
        if (found == record.outputs.end()) continue;
        for (const CellOutput& output : found->second) printed += output.printed;
    }
    return printed.size() > kPrinted ? printed.substr(printed.size() - kPrinted) : printed;
}

json json_of(const RunRecord& record, const PercentScript& script) {
    const json whole = json::parse(to_json(record));
    json result = {{"answers", whole.at("answers")}, {"values", whole.at("values")},
                   {"figures", json::object()},      {"tables", json::array()},
                   {"texts", json::array()},         {"printed", end_of_printed(record, script)}};
    for (const auto& [name, figure] : record.figures) result["figures"][name] = figure.caption;
    for (const auto& [name, table] : record.tables) result["tables"].push_back(name);
    for (const auto& [name, text] : record.texts) result["texts"].push_back(name);
    if (record.error) result["error"] = record.error->message;
    return result;
}

/// What the end of a copy means for the student; nothing when it ended well.
std::string failure_of(const ChildResult& copy, long time_ms) {
    if (copy.timed_out) return fmt::format("it took more than {} s", static_cast<double>(time_ms) / 1000);
    if (copy.output_exceeded) return "its answers are too large";
    if (copy.exit_code > 128) return fmt::format("it crashed (signal {})", copy.exit_code - 128);
    return copy.exit_code == 0 ? "" : copy.error_output;
}

}  // namespace

json run_for_grading(const json& job) {
    ProcessLimits limits;
    limits.cpu_seconds = static_cast<int>(job.at("time_ms").get<long>() / 500) + 2;  // threads add up
    limits.memory_bytes = job.at("memory_bytes").get<std::uint64_t>() + (2ull << 30);
    limits.open_files = kOpenFiles;
    confine_process(limits);
    try {
        const PercentScript script = read_for_grading(job);
        GnuplotRenderer renderer;
        ReportLanguage language{script.header.language};
        Runtime runtime(options_of(job, script), renderer);
        runtime.set_service(&language);
        const auto start = std::chrono::steady_clock::now();
        json result = json_of(runtime.run(script), script);
        result["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return result;
    } catch (const DocumentError& error) {
        return {{"error", error.what()}};
    }
}

json run_all_for_grading(const json& job) {
    json results = json::object();
    for (const json& run : job.at("runs")) {
        const long time_ms = run.at("time_ms");
        GuardLimits limits;
        limits.timeout = std::chrono::milliseconds(time_ms) + kMargin;
        limits.memory_bytes = run.at("memory_bytes").get<std::uint64_t>() + (2ull << 30);
        limits.output_bytes = kMostAnswers;
        ::setenv("DYNLAB_HOME", run.at("home").get<std::string>().c_str(), 1);
        const ChildResult copy = run_guarded(
            [&run] { return run_for_grading(run).dump(-1, ' ', false, json::error_handler_t::replace); }, limits);
        const std::string failure = failure_of(copy, time_ms + kMargin.count());
        json result = failure.empty() ? json::parse(copy.output, nullptr, false) : json();
        if (!result.is_object())
            result = {{"error", fmt::format("The script was ended: {}.",
                                            failure.empty() ? "its result cannot be read" : failure)}};
        results[run.at("name").get<std::string>()] = std::move(result);
    }
    return results;
}

}  // namespace dynlab
