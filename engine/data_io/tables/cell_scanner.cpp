#include "data_io/tables/cell_scanner.h"

#include <algorithm>

#include "data_io/tables/number_cell.h"
#include "platform/error.h"

namespace dynlab::inline data_io {

bool is_comment(std::string_view line) {
    if (line.empty() || (line.front() != '#' && line.front() != '%')) return false;
    double number = 0;
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r\n,;|"));
    return word.size() < 2 || parse_number(word, number) != NumberStatus::kMissing;
}

bool CellScanner::next_row() {
    constexpr std::string_view kMayNotBeRow = " \t\r\n#%";
    for (; !at_end(); ++line_) {
        if (kMayNotBeRow.find(text_[at_]) == std::string_view::npos) {
            row_at_ = at_;
            row_line_ = line_;
            return true;
        }
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        const std::size_t begin = text_.find_first_not_of(" \t\r", at_);
        const bool blank = begin >= end;
        if (!blank && !is_comment(text_.substr(begin, end - begin))) {
            row_at_ = at_;
            row_line_ = line_;
            if (separator_ == ' ') at_ = begin;
            return true;
        }
        if (!blank) last_comment_ = trimmed_cell(text_.substr(begin + 1, end - begin - 1));
        at_ = std::min(end + 1, text_.size());
    }
    return false;
}

std::string_view CellScanner::next_cell() {
    while (!at_end() && is_blank(text_[at_])) ++at_;
    if (!at_end() && text_[at_] == '"') return next_quoted_cell();
    const std::size_t begin = at_;
    while (!at_end() && !at_separator() && text_[at_] != '\n') ++at_;
    const std::string_view cell = trimmed_cell(text_.substr(begin, at_ - begin));
    pass_cell_end();
    return cell;
}

bool CellScanner::at_separator() const {
    return separator_ == ' ' ? is_blank(text_[at_]) : text_[at_] == separator_;
}

std::string_view CellScanner::next_quoted_cell() {
    unquoted_.clear();
    for (++at_;; ++at_) {
        if (at_end()) throw EnvironmentError("{}, line {}: a quotation mark is not closed", file_.string(), row_line_);
        if (text_[at_] == '"') {
            if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
            ++at_;
        }
        line_ += text_[at_] == '\n';
        unquoted_ += text_[at_];
    }
    ++at_;
    if (separator_ != ' ')
        while (!at_end() && (is_blank(text_[at_]) || text_[at_] == '\r')) ++at_;
    if (!at_end() && !at_separator() && text_[at_] != '\n' && text_[at_] != '\r')
        throw EnvironmentError("{}, line {}: text follows a closing quotation mark", file_.string(), row_line_);
    pass_cell_end();
    return trimmed_cell(unquoted_);
}

void CellScanner::pass_cell_end() {
    if (separator_ == ' ')
        while (!at_end() && (is_blank(text_[at_]) || text_[at_] == '\r')) ++at_;
    row_ended_ = at_end() || text_[at_] == '\n';
    line_ += !at_end() && text_[at_] == '\n';
    if (!at_end() && (row_ended_ || separator_ != ' ')) ++at_;
}

}  // namespace dynlab::inline data_io
