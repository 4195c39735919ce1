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

/// The formulas $...$ and $$...$$ of texts in Markdown as MathML. Pandoc reads them in a box; one that it cannot read
/// stays as it is written, and so do all of them where Pandoc fails.
class TypesetFormulas {
  public:
    TypesetFormulas(const std::vector<std::string>& texts, Isolation isolation);

    /// The text as HTML: escaped, with its formulas typeset.
    std::string html(const std::string& text) const;

  private:
    std::map<std::pair<std::string, bool>, std::string> known_;  ///< formula, whether it is displayed -> MathML
};

}  // namespace dynlab::inline course
