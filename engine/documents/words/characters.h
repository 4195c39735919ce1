#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline documents {

/// What pdflatex can print: ASCII, the letters of the T1 fonts, and those that report_templates/latex declares in
/// characters.tex and vietnamese.tex. HTML, Markdown and LuaLaTeX take every character except control characters.
class PrintableCharacters {
  public:
    static PrintableCharacters of_latex(const std::string& declarations);
    static PrintableCharacters of_html();

    /// A sentence about the first thing in `text` that no document can have: bytes that are not UTF-8, a control
    /// character. Nothing when there is none.
    std::optional<Message> complaint(std::string_view text) const;

    bool can_print(char32_t character) const;

  private:
    bool everything_ = false;
    std::set<char32_t> declared_;
};

/// "U+1EC5".
std::string code_of(char32_t character);

}  // namespace dynlab::inline documents
