#pragma once
#include <optional>
#include <string>

#include "base/message.h"
#include "scripting/runtime/shown_calls.h"

namespace dynlab::inline scripting {

/// Converts every expression at the place of a statement to a call that shows its value, as the prompt does. An
/// expression followed by a semicolon is only evaluated:
///     x + 1        becomes  dynlab.show(x + 1);
///     x + 1;       becomes  local _ = x + 1;
/// An expression starts at the beginning of a line. It ends with a line, or before a semicolon or the end of a block,
/// and may extend over several lines. All other text keeps its place and line. Source that Lua can read is returned
/// unchanged, and so is source that remains invalid. `shown`: functions whose calls also show their values.
std::string with_shown_expressions(const std::string& source, const ShownCalls& shown);

/// A line that Lua takes for something else than its writer meant, and what to write instead.
struct MisreadLine {
    int line;
    Message sentence;
};
/// The first such line: rows of a matrix set apart by semicolons, a decimal comma as in `x = 3,5`, which Lua reads as
/// two values, or a math.max or math.min whose last argument is max(v) or min(v) of one vector, which give the place of
/// the element, too.
std::optional<MisreadLine> misread_line_of(const std::string& source);

}  // namespace dynlab::inline scripting
