#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline documents {

/// What LaTeX can print: ASCII, the letters of the T1 fonts, and the symbols that report_templates/latex/
/// characters.tex declares. HTML and Markdown take every character except control characters.
class PrintableCharacters {
  public:
    static PrintableCharacters of_latex(const std::string& characters_tex);
    static PrintableCharacters of_html();

    /// A sentence about the first character of `text` that cannot be printed, naming it; nothing when all can.
    std::optional<Message> complaint(std::string_view text) const;

  private:
    bool can_print(char32_t character) const;
    bool everything_ = false;
    std::set<char32_t> declared_;
};

}  // namespace dynlab::inline documents
