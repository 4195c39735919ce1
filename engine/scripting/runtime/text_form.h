#pragma once
#include <lua.hpp>
#include <string>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline scripting {

/// The short readable forms that print and tostring show, with numbers as scripts write them.
std::string vector_text(const VectorView& v, const Reader& reader = {});  ///< [1 2 3]; long ones shortened, with size
std::string matrix_text(const MatrixView& m, const Reader& reader = {});  ///< rows under each other, columns aligned
std::string complex_vector_text(const ComplexVector& v, const Reader& reader = {});
/// "-1.5 + 2i", with the reader's decimal sign.
std::string complex_text(const Complex& value, const Reader& reader = {}, int significant_digits = 5);

/// Text of any Lua value: whole numbers without ".0", tables as {1, 2, name = "x"}, objects by their own form. Equal
/// values give equal text in every run (no addresses).
std::string value_text(lua_State* L, int index);
/// The same for reading, as print shows it: numbers with seven digits, tables that one line does not hold in lines.
std::string text_for_reading(lua_State* L, int index);

}  // namespace dynlab::inline scripting
