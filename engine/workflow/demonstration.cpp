#include "workflow/demonstration.h"

#include <algorithm>

#include "documents/text_lines.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/spelling.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// "delays" for 02_delays.lua.
std::string demonstration_name(const fs::path& script) {
    const std::string stem = script.stem().string();
    return stem.substr(stem.find('_') + 1);
}

std::string marked_code(const Cell& cell) {
    std::string marked;
    for (const std::string& line : lines_of(cell.content)) marked += line.empty() ? ">\n" : "> " + line + '\n';
    return marked;
}

std::string results_of(const Cell& cell, const RunRecord& record) {
    std::string results;
    const auto outputs = record.outputs.find(cell.id);
    if (outputs == record.outputs.end()) return results;
    for (const CellOutput& output : outputs->second) {
        results += output.printed;
        if (output.figure) results += "figure: " + record.figures.at(*output.figure).file.string() + '\n';
    }
    return results;
}

}  // namespace

std::vector<Demonstration> demonstrations() {
    std::vector<fs::path> scripts;
    for (const auto& entry : fs::directory_iterator(shared_folder() / "lessons" / "demos")) {
        if (entry.path().extension() == ".lua") scripts.push_back(entry.path());
    }
    std::sort(scripts.begin(), scripts.end());
    std::vector<Demonstration> found;
    for (const fs::path& script : scripts)
        found.push_back({demonstration_name(script), script, read_percent_script(script).header.title});
    return found;
}

Demonstration find_demonstration(const std::string& name) {
    std::vector<std::string> names;
    for (const Demonstration& demonstration : demonstrations()) {
        if (demonstration.name == name) return demonstration;
        names.push_back(demonstration.name);
    }
    if (const auto near = nearest_word(name, names))
        throw EnvironmentError("unknown demonstration '{}'; did you mean '{}'?", name, *near);
    throw EnvironmentError("unknown demonstration '{}'; the demonstrations are {}", name, listed(names));
}

std::vector<std::string> pages_of(const PercentScript& script, const RunRecord& record) {
    const Cell* const failed =
        record.error ? script.cell_at_line(std::max(record.error->line_in(script.file.filename().string()), 1))
                     : nullptr;
    std::vector<std::string> pages;
    std::string page;
    for (const Cell& cell : script.cells) {
        if (cell.kind == Cell::Kind::kText) {
            page += trimmed(cell.content) + "\n\n";
            continue;
        }
        const std::string results = results_of(cell, record);
        pages.push_back(page + marked_code(cell) + (results.empty() ? "" : '\n' + results));
        page.clear();
        if (&cell == failed) return pages;
    }
    if (!page.empty()) pages.push_back(page);
    return pages;
}

}  // namespace dynlab::inline workflow
