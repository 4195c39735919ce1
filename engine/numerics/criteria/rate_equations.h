#pragma once

#include "numerics/criteria/function_library.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Linear equations Theta Xi = B for the coefficients of a library: functions in the columns of Theta, states in those
/// of B.
struct RateEquations {
    Matrix Theta, B;
};

/// Of one experiment from derivatives: state and derivative of the polynomial of degree 4, at most, that is closest to
/// the `window` samples around each one. Samples where a held input jumps within the window are left out. Throws
/// InvalidArgument for fewer samples than the window, and as library_values().
RateEquations derivative_equations(const IdData& data, std::size_t experiment, const FunctionLibrary& library,
                                   int window);

/// Of one experiment in weak form with the test functions (1 - s^2)^8, s = (t - center)/width, `width` in the time unit
/// of the data, centered at every tenth of the width. Throws InvalidArgument for a width that leaves no room or holds
/// fewer than 3 samples, and as library_values().
RateEquations weak_equations(const IdData& data, std::size_t experiment, const FunctionLibrary& library, double width);

/// Half the length of a test function, in the time unit, derived from the data: the lag at which the mean
/// autocorrelation of the states has fallen to one half, between 5 samples and a tenth of the longest experiment.
double usual_width(const IdData& data);

}  // namespace dynlab::inline numerics
