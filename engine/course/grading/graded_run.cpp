#include "course/grading/graded_run.h"

#include <chrono>

#include "documents/error.h"
#include "documents/percent_script.h"
#include "figures/gnuplot_renderer.h"
#include "platform/confinement.h"
#include "scripting/runtime/report_language.h"
#include "scripting/runtime/runtime.h"

namespace dynlab::inline course {
namespace {

using nlohmann::json;

constexpr std::size_t kPrinted = 4000;         // characters that are kept of the end
constexpr std::size_t kMostOutput = 4u << 20;  // of printed text
constexpr int kOpenFiles = 64;

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

}  // namespace dynlab::inline course
