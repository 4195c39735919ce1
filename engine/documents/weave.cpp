#include "documents/weave.h"

#include <algorithm>

#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "documents/words/sentence_catalogue.h"

namespace dynlab::inline documents {
namespace {

/// A fence longer than any run of back-quotes in the text, so that no text can close it.
std::string fence_around(const std::string& text) {
    std::size_t longest = 2, run = 0;
    for (char c : text) {
        run = c == '`' ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    return std::string(longest + 1, '`');
}

bool option_is_off(const Cell& cell, const std::string& key) {
    const auto option = cell.options.find(key);
    return option != cell.options.end() && option->second == "false";
}

std::string fenced(const std::string& text, const std::string& block_class) {
    const std::string fence = fence_around(text);
    return fence + "{." + block_class + "}\n" + text + (text.ends_with('\n') ? "" : "\n") + fence + "\n\n";
}

std::string stopped_here(const std::string& language) {
    return language == "fr" ? "\nLe script s'est arrêté ici ; rien de ce qui suit n'a été exécuté."
                            : "\nThe script stopped here; nothing below was run.";
}

class Weaver {
  public:
    Weaver(const PercentScript& script, const RunRecord& record) : script_(script), record_(record) {}

    MarkdownText weave() {
        const Cell* const failed = record_.error ? script_.cell_at_line(std::max(record_.error->line, 1)) : nullptr;
        for (const Cell& cell : script_.cells) {
            if (cell.kind == Cell::Kind::kText) {
                add_lines(cell);
                add("", cell.last_line());
            } else {
                if (!option_is_off(cell, "echo")) add_code(cell);
                if (!option_is_off(cell, "output")) add_outputs(cell);
            }
            if (&cell == failed) add_error(stopped_here(script_.header.language), cell.last_line());
        }
        if (record_.error && !failed) add_error("", 1);
        return std::move(text_);
    }

  private:
    void add(const std::string& line, int number) { text_.append(line + "\n", script_.file, number); }

    bool is_shown(const std::string& line, int number, bool text_cell) const {
        const std::string as_written = text_cell ? "-- " + line : line;
        return solution_line(as_written, script_.file, number) == SolutionLine::kNone;
    }

    void add_lines(const Cell& cell) {
        int number = cell.first_line;
        for (const std::string& line : lines_of(cell.content)) {
            if (is_shown(line, number, cell.kind == Cell::Kind::kText)) add(line, number);
            ++number;
        }
    }

    void add_code(const Cell& cell) {
        if (cell.content.empty()) return;
        const std::string fence = fence_around(cell.content);
        add(fence + "{.lua .cell}", cell.first_line);
        add_lines(cell);
        add(fence, cell.last_line());
        add("", cell.last_line());
    }

    void add_block(const std::string& text, const std::string& block_class, int number) {
        for (const std::string& line : lines_of(fenced(text, block_class))) add(line, number);
    }

    void add_error(const std::string& more, int number) {
        add_block(told_error(record_.error->message, script_.header.language) + more, "error", number);
    }

    void add_outputs(const Cell& cell) {
        const auto outputs = record_.outputs.find(cell.id);
        if (outputs == record_.outputs.end()) return;
        for (const CellOutput& output : outputs->second) {
            const std::string printed = output.printed.substr(0, output.printed.find_last_not_of('\n') + 1);
            if (!is_blank(printed)) add_block(printed, "output", cell.last_line());
            if (output.figure) add_figure(*output.figure, cell.last_line());
        }
    }

    /// Figures without a caption are shown without a number, so nothing can refer to them.
    void add_figure(const std::string& name, int number) {
        const auto figure = record_.figures.find(name);
        const bool captioned = figure != record_.figures.end() && !figure->second.caption.empty();
        add("![](figure:" + name + ")" + (captioned ? "{#fig:" + name + "}" : ""), number);
        add("", number);
    }

    const PercentScript& script_;
    const RunRecord& record_;
    MarkdownText text_;
};

}  // namespace

void MarkdownText::append(const std::string& lines, const std::filesystem::path& file, int first_line) {
    for (const std::string& line : lines_of(lines)) {
        text += line + "\n";
        origin.push_back({file, first_line++});
    }
}

SourceLine MarkdownText::origin_of(int line) const {
    if (line < 1 || line > static_cast<int>(origin.size())) return {};
    return origin[static_cast<std::size_t>(line) - 1];
}

std::string error_block(const std::string& message) {
    return fenced(message, "error");
}

std::string told_error(const std::string& message, const std::string& language) {
    return language == "fr" ? shared_french_sentences().translated(message) : message;
}

MarkdownText weave_cells(const PercentScript& script, const RunRecord& record) {
    return Weaver(script, record).weave();
}

}  // namespace dynlab::inline documents
