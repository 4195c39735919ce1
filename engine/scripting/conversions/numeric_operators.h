#pragma once
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// Operators of vectors and matrices as metamethods: element by element, with numbers and between equal sizes; `*`
/// between matrices, and between matrix and vector, is the matrix product.
int numeric_add(Call& call);
int numeric_subtract(Call& call);
int numeric_multiply(Call& call);
int numeric_divide(Call& call);
int numeric_power(Call& call);
int numeric_negate(Call& call);
int numeric_times(Call& call);  ///< A:times(B), element by element
int refuse_comparison(Call& call);

}  // namespace dynlab::inline scripting
