#include "course/sandbox_jobs/graded_run.h"
#include "course/sandbox_jobs/sandbox_messages.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kPrinted = 4000;                           // characters that are kept of the end
constexpr std::size_t kMaxAnswerBytes = kMaxGradedRunBytes / 2;  // bytes as they are, which escapes can make more

std::string end_of_printed(const RunRecord& record, const PercentScript& script) {
    std::string printed;
    for (const Cell& cell : script.cells) {
        const auto found = record.outputs.find(cell.id);
        if (found == record.outputs.end()) continue;
        for (const CellOutput& output : found->second) printed += output.printed;
    }
    return printed.size() > kPrinted ? printed.substr(printed.size() - kPrinted) : printed;
}

/// A result that exceeds the sandbox's output limit would be lost completely. Each answer that does not fit is left out
/// instead, and the error names the first.
void keep_what_fits(GradedRun& run) {
    std::size_t used = 0;
    const auto fits = [&](std::size_t bytes) {
        if (used + bytes > kMaxAnswerBytes) return false;
        used += bytes;
        return true;
    };
    for (auto answer = run.answers.begin(); answer != run.answers.end();) {
        if (fits(answer->first.size() + answer->second.json.size())) {
            ++answer;
            continue;
        }
        if (!run.error)
            run.error = Message(
                "the answer \"{}\" is too large. All answers together can have at most {} MB, so submit fewer numbers",
                answer->first, kMaxAnswerBytes >> 20);
        answer = run.answers.erase(answer);
    }
    for (std::vector<std::string>* names : {&run.figures, &run.values})
        std::erase_if(*names, [&](const std::string& name) { return !fits(name.size()); });
}

}  // namespace

GradedRun graded_run(RunRecord&& record, const PercentScript& script) {
    GradedRun run;
    run.printed = end_of_printed(record, script);
    for (const auto& [name, figure] : record.figures) run.figures.push_back(name);
    for (const auto& [name, value] : record.values) run.values.push_back(name);
    run.answers = std::move(record.answers);
    if (record.error) run.error = with_place(*record.error);
    keep_what_fits(run);
    return run;
}

}  // namespace dynlab::inline course
