#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// Functions whose results are printed when a statement consists of their call only: the functions of a table whose
/// signature has results, except functions that draw, print or are called for a side effect.
class ShownCalls {
  public:
    ShownCalls() = default;  ///< none
    explicit ShownCalls(FunctionEntries functions);

    /// The names of the values where they are several, no names for one value; nullptr for other functions.
    const std::vector<std::string>* find(std::string_view function) const;

  private:
    std::map<std::string_view, std::vector<std::string>> names_;
};

/// The source with every call, alone in its lines, of a function that only computes made into one that shows what it
/// gives, several results with their names: "damp(G)" as MATLAB shows it. A call with a semicolon behind it stays as it
/// is, and so does that of a name that the script itself has defined before it, in a block that is open there or for
/// all.
std::string with_shown_calls(const std::string& source, const ShownCalls& shown);

}  // namespace dynlab::inline scripting
