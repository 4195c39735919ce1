#include "platform/terminal/aligned_table.h"

#include <algorithm>

#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

std::string shown(std::string cell) {
    for (char& c : cell)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return cell;
}

}  // namespace

std::string aligned_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const std::string& name : header) widths.push_back(columns_of(name));
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(shown(row[i])));
    std::string text;
    const auto append = [&](const std::vector<std::string>& row) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string cell = shown(row[i]);
            line += cell + std::string(widths[i] - columns_of(cell) + 2, ' ');
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    };
    append(header);
    std::vector<std::string> rule;
    for (const std::size_t width : widths) rule.emplace_back(width, '-');
    append(rule);
    for (const auto& row : rows) append(row);
    return text;
}

}  // namespace dynlab::inline platform
