#include "scripting/runtime/script_parts.h"

#include <algorithm>

#include "documents/text_lines.h"
#include "scripting/runtime/prompt_statement.h"

namespace dynlab::inline scripting {
namespace {

std::string lines_between(const std::vector<std::string>& lines, int first, int last) {
    std::string text;
    for (int line = first; line <= std::min<int>(last, static_cast<int>(lines.size())); ++line)
        text += lines[static_cast<std::size_t>(line) - 1] + "\n";
    return text;
}

}  // namespace

std::vector<ScriptPart> script_parts(const PercentScript& script) {
    const std::vector<std::string> lines = lines_of(script.source);
    std::vector<ScriptPart> parts;
    bool goes_on = false;
    for (const Cell& cell : script.cells) {
        if (cell.kind != Cell::Kind::kCode) continue;
        if (!goes_on) parts.push_back({cell.first_line, "", {}});
        ScriptPart& part = parts.back();
        part.cells.push_back(cell.id);
        part.code = lines_between(lines, part.first_line, cell.last_line());
        goes_on = read_script_part(part.code, {}).kind == PromptStatement::Kind::kIncomplete;
    }
    return parts;
}

}  // namespace dynlab::inline scripting
