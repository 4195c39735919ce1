#include "workflow/site/table_columns.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "documents/text_lines.h"

namespace dynlab::inline workflow {
namespace {

constexpr std::size_t kWide = 72;     // characters of a line from which on Pandoc shares the width
constexpr double kWidth = 90;         // characters of a whole line on the page
constexpr double kMin = 4;            // of a column
constexpr double kMaxWidthRatio = 4;  // times

/// The cells of a line "| a | b |"; bars in code and behind a backslash belong to the cell.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells = {""};
    bool code = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\\' && i + 1 < line.size()) {
            cells.back() += line[++i];
        } else if (line[i] == '|' && !code) {
            cells.emplace_back();
        } else {
            code = code != (line[i] == '`');
            cells.back() += line[i];
        }
    }
    for (std::string& cell : cells) cell = trimmed(cell);
    if (cells.front().empty()) cells.erase(cells.begin());
    if (!cells.empty() && cells.back().empty()) cells.pop_back();
    return cells;
}

bool is_rule(const std::string& line) {
    return line.starts_with('|') && line.find("--") != std::string::npos &&
           line.find_first_not_of("|:- ") == std::string::npos;
}

/// As it is printed: letters, without the marks of code and emphasis.
double length_of(const std::string& cell) {
    return static_cast<double>(std::ranges::count_if(
        cell, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80 && c != '`' && c != '*'; }));
}

/// What fits is given its length, round after round, as long as that leaves more to the others.
std::vector<double> widths_for(const std::vector<double>& lengths) {
    std::vector<double> widths(lengths.size(), 0);
    std::vector<std::size_t> open(lengths.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
    double left = kWidth;
    for (bool changed = true; changed && !open.empty();) {
        const double part = left / static_cast<double>(open.size());
        const auto fits = [&](std::size_t i) { return lengths[i] <= part; };
        for (const std::size_t i : open)
            if (fits(i)) left -= widths[i] = std::max(kMin, lengths[i]);
        changed = std::erase_if(open, fits) > 0;
    }
    if (open.empty()) return widths;
    double longest = 0, sum = 0;
    for (const std::size_t i : open) longest = std::max(longest, lengths[i]);
    for (const std::size_t i : open) sum += std::max(lengths[i], longest / kMaxWidthRatio);
    for (const std::size_t i : open) widths[i] = left * std::max(lengths[i], longest / kMaxWidthRatio) / sum;
    return widths;
}

/// Dashes of these numbers, colons where the rule has them.
std::string rule_with(const std::string& rule, const std::vector<double>& widths) {
    const std::vector<std::string> old = cells_of(rule);
    std::string text = "|";
    for (std::size_t i = 0; i < old.size(); ++i) {
        text += old[i].starts_with(':') ? ":" : "-";
        text += std::string(static_cast<std::size_t>(std::lround(widths[i])), '-');
        text += old[i].ends_with(':') ? ":|" : "-|";
    }
    return text;
}

}  // namespace

std::string with_fitted_columns(const std::string& markdown) {
    std::vector<std::string> lines = lines_of(markdown);
    FencedCode code;
    for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
        if (code.holds(lines[k]) || !lines[k].starts_with('|') || !is_rule(lines[k + 1])) continue;
        std::vector<double> lengths(cells_of(lines[k + 1]).size(), 0);
        std::size_t longest = 0, end = k;
        for (; end < lines.size() && lines[end].starts_with('|'); ++end) {
            if (end == k + 1) continue;
            longest = std::max(longest, lines[end].size());
            const std::vector<std::string> cells = cells_of(lines[end]);
            for (std::size_t i = 0; i < std::min(cells.size(), lengths.size()); ++i)
                lengths[i] = std::max(lengths[i], length_of(cells[i]));
        }
        if (longest > kWide) lines[k + 1] = rule_with(lines[k + 1], widths_for(lengths));
        k = end - 1;
    }
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

}  // namespace dynlab::inline workflow
