#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Scans the cells of a separated text: one row per line, except that a cell in quotes may contain separators, line
/// ends and doubled quotes (RFC 4180). Blank lines and lines that begin with # or % are skipped. The separator ' '
/// means any number of blanks and tabs, at the ends of a line too.
class CellScanner {
  public:
    /// From the byte `at` of `text`, where line number `line` begins; both texts must live as long as this.
    CellScanner(const std::filesystem::path& file, std::string_view text, char separator, std::size_t at,
                std::size_t line)
        : file_(file), text_(text), separator_(separator), at_(at), line_(line) {}

    /// Goes to the next row; false at the end of the text. Call it when the current row has ended.
    bool next_row();
    /// Its next cell, without blanks around it; valid until the next call. There is at least one.
    std::string_view next_cell();
    bool row_ended() const { return row_ended_; }                    ///< after its last cell
    std::size_t line() const { return row_line_; }                   ///< on which the current row begins
    std::size_t place() const { return row_at_; }                    ///< byte at which it begins
    std::string_view last_comment() const { return last_comment_; }  ///< without its sign; empty when there was none

  private:
    bool is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }
    bool at_end() const { return at_ >= text_.size(); }
    std::string_view next_quoted_cell();
    void pass_cell_end();
    bool at_separator() const;

    const std::filesystem::path& file_;
    std::string_view text_;
    char separator_;
    std::size_t at_, line_;
    std::size_t row_at_ = 0, row_line_ = 1;
    bool row_ended_ = false;
    std::string unquoted_;
    std::string_view last_comment_;
};

/// Whether a line, without blanks before it, is a comment: it begins with # or %, and not with a spreadsheet's error
/// value such as #N/A.
bool is_comment(std::string_view line);

}  // namespace dynlab::inline data_io
