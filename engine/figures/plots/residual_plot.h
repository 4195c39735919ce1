#pragma once
#include "figures/figure.h"
#include "numerics/signals/iddata.h"
#include "numerics/validation/residual_tests.h"

namespace dynlab::inline figures {

/// Residual tests as stems over the lags: a column of panels per output, the autocorrelation of its simulation error on
/// top (lag 0, always 1, left out), below it the cross-correlation with each input. Bounds are bands; stems beyond them
/// are highlighted. Throws InvalidArgument if every output is reproduced exactly, or if tests and data do not belong
/// together.
Figure residual_plot(const ResidualTests& tests, const IdData& data, double confidence = 0.99);

}  // namespace dynlab::inline figures
