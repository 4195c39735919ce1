#pragma once
#include <algorithm>
#include <string>

#include "course/intake/issue.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {

/// Whether a code cell contains more than comments.
inline bool has_code(const PercentScript& script) {
    return std::ranges::any_of(script.cells, [](const Cell& cell) {
        return cell.kind == Cell::Kind::kCode && std::ranges::any_of(lines_of(cell.content), [](const auto& line) {
                   const std::string text = trimmed(line);
                   return !text.empty() && !text.starts_with("--");
               });
    });
}

/// A script of text alone passes all other checks of an analysis.
inline void add_if_without_code(const PercentScript& script, const std::string& place, Issues& findings) {
    if (has_code(script)) return;
    findings.push_back({"script-empty", Severity::kHint, 0, place,
                        Message("The script contains no code, so it computes nothing."),
                        Message("Write the analysis in {}.", place)});
}

}  // namespace dynlab::inline course
