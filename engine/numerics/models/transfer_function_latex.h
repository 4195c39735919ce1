#pragma once
#include <string>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// G as a formula of LaTeX, "G(s) = \frac{2}{s + 1} e^{-0.5 s}", without what sets it apart from text.
std::string to_latex(const TransferFunction& G, int significant_digits = 5);

}  // namespace dynlab::inline numerics
