#include "course/grading/script_code.h"

#include <algorithm>

#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

/// Whether a cell contains more than comments.
bool has_code(const Cell& cell) {
    return cell.kind == Cell::Kind::kCode && std::ranges::any_of(lines_of(cell.content), [](const auto& line) {
               const std::string text = trimmed(line);
               return !text.empty() && !text.starts_with("--");
           });
}

}  // namespace

void add_if_without_code(const PercentScript& script, const std::string& place, Issues& findings) {
    if (std::ranges::any_of(script.cells, has_code)) return;
    findings.push_back({"script-empty", Severity::kHint, 0, place,
                        Message("The script contains no code, so it computes nothing."),
                        Message("Write the analysis in {}.", place)});
}

}  // namespace dynlab::inline course
