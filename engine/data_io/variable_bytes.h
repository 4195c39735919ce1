#pragma once
#include <string>
#include <string_view>

#include "data_io/variable.h"

namespace dynlab::inline data_io {

/// A private binary form that carries variables from one process of this program to another on the same machine.
std::string bytes_of(const VariableTable& variables);

/// Throws EnvironmentError when `bytes` are not whole, whatever they are.
VariableTable variables_of(std::string_view bytes);

}  // namespace dynlab::inline data_io
