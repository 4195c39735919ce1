#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline scripting {

/// The ways to call a function: "step(G, t) -> y; step(G1, ...) -> fig" taken apart at the semicolons.
std::vector<std::string> forms_of(const std::string& signature);

/// The text between the brackets of "f(data, {na, nb}, x, {options}) -> G", split at the outer commas.
std::vector<std::string> arguments_of(const std::string& form);

/// Whether an argument of a form is a table of options.
bool is_options(const std::string& argument);

/// The place of the table of options among the arguments, from 0; where it varies the first. Nothing for a function
/// without options.
std::optional<std::size_t> place_of_options(const FunctionEntry& function);

}  // namespace dynlab::inline scripting
