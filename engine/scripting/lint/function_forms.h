#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// The row of the catalogue; nullptr for other names.
const FunctionEntry* find_function(const std::string& name);

/// The ways to call a function: "step(G, t) -> y; step(G1, ...) -> fig" taken apart at the semicolons.
std::vector<std::string> forms_of(const std::string& signature);

/// What stands between the brackets of "f(data, {na, nb}, x, {hold =}) -> G", taken apart at the outer commas.
std::vector<std::string> arguments_of(const std::string& form);

/// Whether an argument of a form is a table of options: "{lambda =, Tol =, ...}".
bool is_options(const std::string& argument);

/// The names that a function's help page describes under its arguments, each with its words.
std::vector<std::pair<std::string, std::string>> described_options(const std::string& function);

/// The options that a function takes, as its signature and its help page tell them.
struct FunctionOptions {
    std::size_t first_place = 0;         ///< of the table among the arguments, from 0; where it varies the first
    std::vector<std::string> names;      ///< those that are described
    std::vector<std::string> mentioned;  ///< sorted: every name in code on this page or on one it points to
    /// Whether the pages know an option of this name; its first letter may be of the other case.
    bool knows(const std::string& name) const;
};
std::optional<FunctionOptions> options_of_function(const std::string& function);

}  // namespace dynlab::inline scripting
