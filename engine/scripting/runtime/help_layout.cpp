#include "scripting/runtime/help_layout.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "documents/text_lines.h"
#include "platform/utf8.h"

namespace dynlab::inline scripting {
namespace {

using Cells = std::vector<std::string>;

std::vector<std::string> lines_filled(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    for (const std::string& word : words_between_spaces(text)) {
        if (!lines.empty() && columns_of(lines.back()) + 1 + columns_of(word) <= width)
            lines.back() += ' ' + word;
        else
            lines.push_back(word);
    }
    if (lines.empty()) lines.emplace_back();
    return lines;
}

bool is_in_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// The text without the backticks of code and the stars of emphasis; text inside code stays unchanged.
std::string without_marks(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '`') {
            std::size_t ticks = 1;
            while (i + ticks < text.size() && text[i + ticks] == '`') ++ticks;
            const std::size_t begin = i + ticks, end = text.find(std::string(ticks, '`'), begin);
            if (end == std::string_view::npos) break;
            std::string_view code = text.substr(begin, end - begin);
            if (ticks > 1 && code.starts_with(' ') && code.ends_with(' ')) code = code.substr(1, code.size() - 2);
            plain += code;
            i = end + ticks - 1;
        } else if (text[i] == '\\' && i + 1 < text.size() && std::string_view("|*_\\").find(text[i + 1]) != text.npos) {
            plain += text[++i];
        } else if (text[i] != '*' ||
                   (i > 0 && i + 1 < text.size() && is_in_word(text[i - 1]) && is_in_word(text[i + 1]))) {
            plain += text[i];
        }
    }
    return plain;
}

/// "| a | b \| c |" as its cells.
Cells cells_of(std::string_view row) {
    Cells cells;
    std::string cell;
    for (std::size_t i = 1; i < row.size(); ++i) {
        if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') {
            cell += row[++i];
        } else if (row[i] == '|') {
            cells.push_back(without_marks(trimmed(cell)));
            cell.clear();
        } else {
            cell += row[i];
        }
    }
    return cells;
}

bool is_rule(const Cells& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
        return !cell.empty() && cell.find_first_not_of("-:") == std::string::npos;
    });
}

/// How many characters the number of a list's item takes ("12. "); 0 for other lines.
std::size_t number_length(std::string_view line) {
    std::size_t digits = 0;
    while (digits < line.size() && digits < 3 && std::isdigit(static_cast<unsigned char>(line[digits]))) ++digits;
    return digits > 0 && line.substr(digits).starts_with(". ") ? digits + 2 : 0;
}

/// As wide as the cells want, the widest made narrower until all fit.
std::vector<std::size_t> column_widths(const std::vector<Cells>& rows, std::size_t width) {
    std::vector<std::size_t> widths;
    for (const Cells& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
    }
    constexpr std::size_t kGap = 2, kMinWidth = 8;
    const auto total = [&] {
        std::size_t sum = 0;
        for (const std::size_t one : widths) sum += one + kGap;
        return sum;
    };
    while (!widths.empty() && total() > width + kGap) {
        auto& widest = *std::max_element(widths.begin(), widths.end());
        if (widest <= kMinWidth) break;
        --widest;
    }
    return widths;
}

std::string filled_table(const std::vector<Cells>& rows, std::size_t width) {
    const std::vector<std::size_t> widths = column_widths(rows, width);
    std::string text;
    bool head = true;
    for (const Cells& row : rows) {
        std::vector<std::vector<std::string>> columns;
        std::size_t height = 1;
        for (std::size_t i = 0; i < row.size(); ++i) {
            columns.push_back(lines_filled(row[i], widths[i]));
            height = std::max(height, columns.back().size());
        }
        for (std::size_t k = 0; k < height; ++k) {
            std::string line;
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const std::string part = k < columns[i].size() ? columns[i][k] : "";
                line += part + std::string(std::max(widths[i] + 2, columns_of(part) + 2) - columns_of(part), ' ');
            }
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + '\n';
        }
        if (head) {
            for (const std::size_t one : widths) text += std::string(one, '-') + "  ";
            text.erase(text.find_last_not_of(' ') + 1);
            text += '\n';
        }
        head = false;
    }
    return text;
}

/// Reads a page block by block.
class PageReader {
  public:
    explicit PageReader(std::size_t width) : width_(width) {}

    std::string read(std::string_view markdown) {
        bool code = false;
        for (const std::string& line : lines_of(markdown)) {
            const bool fence = line.starts_with("```");
            if (fence) end_block();
            if (fence || code) {
                if (!fence) text_ += line.empty() ? "\n" : "    " + line + '\n';
                code = code != fence;
                continue;
            }
            read_line(line);
        }
        end_block();
        return std::move(text_);
    }

  private:
    void read_line(std::string line) {
        const bool quoted = line.starts_with('>');
        if (quoted) line.erase(0, line.starts_with("> ") ? 2 : 1);
        if (quoted != quoted_ && !(quoted_ && !block_.empty() && continues(line))) {  // or its last line lacks the sign
            end_block();
            quoted_ = quoted;
        }
        const bool row = line.starts_with('|'), heading = line.starts_with('#');
        const bool item = line.starts_with("- ") || line.starts_with("* ");
        // Within a paragraph a number is no item: a sentence may go on with "2. ".
        const std::size_t number = block_.empty() || numbered_ ? number_length(line) : 0;
        const bool formula = block_.empty() && rows_.empty() && !quoted_ && line.starts_with("    ");
        if (line.empty() || heading || item || number > 0 || row != !rows_.empty()) end_block();
        numbered_ = number > 0 || (numbered_ && !block_.empty());
        if (line.empty() || formula) {
            text_ += line + '\n';
        } else if (heading) {
            const std::string words = without_marks(line.substr(line.find_first_not_of("# ")));
            text_ += words + '\n' + std::string(columns_of(words), line[1] == '#' ? '-' : '=') + '\n';
        } else if (row) {
            if (Cells cells = cells_of(line); !is_rule(cells)) rows_.push_back(std::move(cells));
        } else {
            if (number > 0) indent_ = number;
            add_words(line, item);
        }
    }

    /// A backslash at the end of a line ends it in the text, too.
    void add_words(const std::string& line, bool item) {
        std::string words = trimmed(line);
        if (item) {
            indent_ = 2;
            words[0] = '-';
        }
        const bool ends = words.ends_with('\\') && !words.ends_with("\\\\");
        if (ends) words.pop_back();
        block_ += (block_.empty() ? "" : " ") + words;
        if (ends) end_line();
        broken_ = broken_ || ends;
    }

    /// Whether a line goes on with the paragraph before it, whatever signs that one had.
    static bool continues(const std::string& line) {
        return !line.empty() && !line.starts_with('|') && !line.starts_with('#') && !line.starts_with("- ") &&
               !line.starts_with("* ");
    }

    void end_line() {
        const std::size_t margin = quoted_ ? kQuotationMargin : 0, first = margin + (broken_ ? indent_ : 0);
        if (!block_.empty())
            text_ += std::string(first, ' ') + filled(without_marks(block_), width_, indent_ + margin) + '\n';
        block_.clear();
    }

    void end_block() {
        end_line();
        if (!rows_.empty()) text_ += filled_table(rows_, width_);
        rows_.clear();
        indent_ = 0;
        broken_ = false;
    }

    static constexpr std::size_t kQuotationMargin = 4;

    std::size_t width_, indent_ = 0;
    bool quoted_ = false, broken_ = false;  // broken_: the block has had a line that its author ended
    bool numbered_ = false;                 // the block is an item of a numbered list
    std::string text_, block_;
    std::vector<Cells> rows_;
};

}  // namespace

std::string filled(std::string_view text, std::size_t width, std::size_t indent) {
    const std::size_t max_width = width > indent ? width - indent : 1;
    std::string result;
    for (const std::string& line : lines_filled(text, max_width))
        result += (result.empty() ? "" : '\n' + std::string(indent, ' ')) + line;
    return result;
}

std::string laid_out(std::string_view markdown, std::size_t width) {
    return PageReader(width).read(markdown);
}

}  // namespace dynlab::inline scripting
