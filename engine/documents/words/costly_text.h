#pragma once
#include <optional>
#include <string_view>

#include "base/message.h"

namespace dynlab::inline documents {

/// Pandoc tries every way to read a sign that opens something and is never closed. Its time grows with the square of
/// their number in a paragraph; with quotes in a link's title, and with single quotes in double ones in single ones, it
/// doubles with each. This class looks for such paragraphs before Pandoc runs, over all the texts of one document. It
/// does not know code and formulas, so its limits leave room for what they hold.
class CostlyText {
  public:
    /// The line (1-based) on which the paragraph begins with which the document would take minutes, if there is one.
    std::optional<int> line_of(std::string_view markdown);

    static Message complaint();  ///< about that paragraph

  private:
    double left_ = 1500.0 * 1500.0;  ///< of the squares; 1500 signs in one paragraph take Pandoc some 10 s
};

}  // namespace dynlab::inline documents
