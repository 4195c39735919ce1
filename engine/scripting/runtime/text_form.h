#pragma once
#include <lua.hpp>
#include <string>

#include "base/number_text.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline scripting {

/// The short readable forms that print and tostring show, with number_text() for the numbers.
std::string vector_text(const VectorView& v);  ///< [1 2 3]; long ones shortened, with their length
std::string matrix_text(const MatrixView& m);  ///< rows under each other, columns aligned
std::string complex_text(const Complex& value, int significant_digits = 5);
std::string complex_vector_text(const ComplexVector& v);

/// Text of any Lua value: whole numbers without ".0", tables as {1, 2, name = "x"}, objects by their own form. Equal
/// values give equal text in every run (no addresses).
std::string value_text(lua_State* L, int index);
/// The same for reading, as print shows it: numbers with seven digits, tables that one line does not hold in lines.
std::string text_for_reading(lua_State* L, int index);

}  // namespace dynlab::inline scripting
