#pragma once
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/sandbox.h"

namespace dynlab::inline course {

/// The text with & < > " as entities, and without control characters.
std::string escaped_html(std::string_view text);

/// The formulas $...$ and $$...$$ of Markdown texts as MathML. Pandoc reads them in a sandbox. A formula that Pandoc
/// cannot read stays as source text; if Pandoc fails, all formulas do.
class TypesetFormulas {
  public:
    TypesetFormulas(const std::vector<std::string>& texts, Isolation isolation);

    /// The text as HTML: escaped, with its formulas typeset.
    std::string html(const std::string& text) const;

  private:
    std::map<std::pair<std::string, bool>, std::string> known_;  ///< formula, whether it is displayed -> MathML
};

}  // namespace dynlab::inline course
