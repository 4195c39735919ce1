#pragma once
#include "numerics/fit/recursive/recursive_pass.h"

namespace dynlab::inline numerics {

/// lssvf in one pass, sample by sample: least squares of the equation A(p) y = B(p) u(t - delay) + e with all signals
/// filtered by 1/(p + lambda)^n, older samples forgotten, or with parameters that walk at random (a Kalman filter whose
/// measurement is the filtered equation). With forgetting 1 and no drift the end is lssvf's theta to rounding. Biased
/// by noise on the output as lssvf is. Standard errors are those of a white equation error. Sizes, options and what is
/// thrown: fit/recursive/recursive_pass.h. Reference: Young (2011), chapters 3 and 4; Bierman (1977), chapter V.
Fit rlssvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options);

}  // namespace dynlab::inline numerics
