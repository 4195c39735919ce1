#include "course/boxes/graded_run.h"
#include "course/boxes/told_reason.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kPrinted = 4000;  // characters that are kept of the end

std::string end_of_printed(const RunRecord& record, const PercentScript& script) {
    std::string printed;
    for (const Cell& cell : script.cells) {
        const auto found = record.outputs.find(cell.id);
        if (found == record.outputs.end()) continue;
        for (const CellOutput& output : found->second) printed += output.printed;
    }
    return printed.size() > kPrinted ? printed.substr(printed.size() - kPrinted) : printed;
}

}  // namespace

GradedRun graded_run(RunRecord&& record, const PercentScript& script) {
    GradedRun run;
    run.printed = end_of_printed(record, script);
    for (const auto& [name, figure] : record.figures) run.figures.push_back(name);
    for (const auto& [name, value] : record.values) run.values.push_back(name);
    run.answers = std::move(record.answers);
    if (record.error) run.error = with_place(*record.error);
    return run;
}

}  // namespace dynlab::inline course
