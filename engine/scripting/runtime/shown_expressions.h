#pragma once
#include <optional>
#include <string>

#include "base/message.h"
#include "scripting/runtime/shown_calls.h"

namespace dynlab::inline scripting {

/// The source with every expression that stands where a statement belongs made into a call that shows its value, as the
/// prompt does; one with a semicolon behind it is only evaluated:
///     x + 1        becomes  dynlab.show(x + 1);
///     x + 1;       becomes  local _ = x + 1;
/// An expression begins a line and ends one, or ends before a semicolon or the end of a block; it may go over several
/// lines. All other text keeps its place and line. A source that Lua can read comes back as it is, and so does one that
/// stays wrong. `shown`: the functions whose calls show their values, too.
std::string with_shown_expressions(const std::string& source, const ShownCalls& shown);

/// The line in which the rows of matrix{...} are set apart by semicolons, as MATLAB writes them: Lua takes a semicolon
/// for a comma, so that one long row would come of it.
std::optional<int> line_with_semicolon_rows(const std::string& source);

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
