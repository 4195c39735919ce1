#include "documents/weave.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/languages.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "figures/figure.h"
#include "figures/readable_figure.h"

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

/// Text as Markdown that prints it: every mark escaped that could mean something. Brackets get their numbers, since
/// \[V\] looks like a formula of LaTeX (latex_remains.h).
std::string literal(const std::string& text) {
    std::string markdown;
    for (const char c : text) {
        if (c == '[' || c == ']') {
            markdown += c == '[' ? "&#91;" : "&#93;";
            continue;
        }
        if (std::string_view("\\`*_{}#^~$@<>|&").find(c) != std::string_view::npos) markdown += '\\';
        markdown += c;
    }
    return markdown;
}

/// Text of a figure as Markdown, its `x_{max}` and `e^{-t}` lowered and raised.
std::string literal_of_figure(const std::string& text) {
    std::string markdown;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t open = std::min(text.find("_{", i), text.find("^{", i));
        const std::size_t close = open == std::string::npos ? open : text.find('}', open);
        markdown += literal(text.substr(i, close == std::string::npos ? close : open - i));
        if (close == std::string::npos) break;
        const char* const mark = text[open] == '_' ? "~" : "^";
        markdown += mark + replaced(literal(text.substr(open + 2, close - open - 2)), " ", "\\ ") + mark;
        i = close + 1;
    }
    return markdown;
}

/// Of histograms: the horizontal axes are what is counted, the vertical ones name the rows.
Message histograms_of(const MessageList& counted, const MessageList& rows) {
    return rows.items.empty() ? Message("Histograms of {}", counted) : Message("Histograms of {}: {}", counted, rows);
}

bool shows_histograms(const Figure& figure) {
    return !figure.panels.empty() && std::ranges::all_of(figure.panels, [](const Panel& panel) {
        return !panel.curves.empty() && panel.curves.front().style == CurveStyle::kBars;
    });
}

/// "y (m), u (V) over time (s)": time is a separate sentence, as other languages have an article there.
Message over_axis(const MessageList& drawn, const std::string& over, const Reader& reader) {
    if (over.empty()) return Message("{}", drawn);
    const std::string time = message_text(Message("time"), reader);
    if (over.starts_with(time)) return Message("{} over time{}", drawn, over.substr(time.size()));
    return Message("{} versus {}", drawn, over);
}

class Weaver {
  public:
    Weaver(const PercentScript& script, const RunRecord& record) : script_(script), record_(record) {}

    MarkdownText weave() {
        const Cell* const failed =
            record_.error ? script_.cell_at_line(std::max(record_.error->line_in(script_.file.filename().string()), 1))
                          : nullptr;
        for (const Cell& cell : script_.cells) {
            if (cell.kind == Cell::Kind::kText) {
                add_lines(cell);
                add("", cell.last_line());
            } else {
                if (!option_is_off(cell, "echo")) add_code(cell);
                if (!option_is_off(cell, "output")) add_outputs(cell);
            }
            if (&cell == failed)
                add_error(Message("The script stopped here; the cells below were not run."), cell.last_line());
        }
        if (record_.error && !failed) add_error({}, 1);
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

    void add_error(const Message& more, int number) {
        const Reader reader{catalog_of(script_.header.language)};
        std::string text = record_.error->text(reader);
        if (!more.empty()) text += "\n" + message_text(more, reader);
        add_block(text, "error", number);
    }

    void add_outputs(const Cell& cell) {
        const auto outputs = record_.outputs.find(cell.id);
        if (outputs == record_.outputs.end()) return;
        for (const CellOutput& output : outputs->second) {
            const std::string printed = output.printed.substr(0, output.printed.find_last_not_of('\n') + 1);
            if (!is_blank(printed)) add_block(printed, "output", cell.last_line());
            if (output.figure) add_figure(*output.figure, cell);
        }
    }

    void add_figure(const std::string& name, const Cell& cell) {
        const auto figure = record_.figures.find(name);
        std::string caption;
        if (figure != record_.figures.end() && figure->second.caption.empty()) {
            const Reader reader{catalog_of(script_.header.language)};
            const RecordedFigure& made = figure->second;
            caption = made.axes.empty() && made.figure ? words_of_axes(*made.figure, reader) : made.axes;
            if (caption.empty()) caption = message_text(Message("From the cell `{}`", cell.id), reader);
        }
        add(fmt::format("![{}](figure:{}){{#fig:{}}}", caption, name, name), cell.last_line());
        add("", cell.last_line());
    }

    const PercentScript& script_;
    const RunRecord& record_;
    MarkdownText text_;
};

}  // namespace

std::string words_of_axes(const Figure& figure, const Reader& reader) {
    Figure axes;
    for (const Panel& panel : figure.panels) {
        Panel& own = axes.panels.emplace_back();
        own.x_label = panel.x_label;
        own.y_label = panel.y_label;
    }
    std::vector<std::string> drawn, counted;
    std::string over;
    const auto add = [](std::vector<std::string>& labels, const std::string& label) {
        if (!label.empty() && std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
    };
    for (const Panel& panel : readable(axes, reader).panels) {
        add(drawn, literal_of_figure(message_text(panel.y_label)));
        if (panel.x_label.empty()) continue;
        over = literal_of_figure(message_text(panel.x_label));
        add(counted, over);
    }
    if (shows_histograms(figure) && !counted.empty())
        return message_text(histograms_of(listed(counted), listed(drawn)), reader);
    if (drawn.empty()) return {};
    const std::string words = message_text(over_axis(listed(drawn), over, reader), reader);
    const std::size_t second = static_cast<unsigned char>(words[0]) < 0x80 ? 1 : 2;  // bytes of a letter of French
    const bool word = second < words.size() && std::islower(static_cast<unsigned char>(words[second]));
    return word ? with_first_letter(words, true) : words;
}

void MarkdownText::append(const std::string& lines, const std::filesystem::path& file, int first_line) {
    for (const std::string& line : lines_of(lines)) {
        text += line + "\n";
        origin.push_back({file, first_line++});
    }
}

Place MarkdownText::origin_of(int line) const {
    if (line < 1 || line > static_cast<int>(origin.size())) return {};
    return origin[static_cast<std::size_t>(line) - 1];
}

std::string error_block(const std::string& message) {
    return fenced(message, "error");
}

MarkdownText weave_cells(const PercentScript& script, const RunRecord& record) {
    return Weaver(script, record).weave();
}

}  // namespace dynlab::inline documents
