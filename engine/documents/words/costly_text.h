#pragma once
#include <optional>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline documents {

/// Pandoc tries every way to read what opens and is never closed: each further `[` of a paragraph may double its time,
/// and thousands of `<` take minutes. This counts beforehand how long that gets, over all the texts of one document.
class CostlyText {
  public:
    /// The line (1-based) on which the paragraph begins with which the document would take minutes, if there is one.
    std::optional<int> line_of(std::string_view markdown);

    static Message complaint();  ///< about that paragraph

  private:
    double left_ = 250;  ///< of some 0.03 s of Pandoc each
};

}  // namespace dynlab::inline documents
