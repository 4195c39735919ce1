#include "numerics/signals/unwrap.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/checks.h"

namespace dynlab::inline numerics {

namespace {

/// A step without the periods in it: between minus and plus half of one.
double smallest_step(double step, double period) {
    return step - period * std::round(step / period);
}

}  // namespace

Vector unwrap(const VectorView& x, double period) {
    check_samples("unwrap", SignalName::kSignal, x);
    if (!(period > 0) || !std::isfinite(period))
        throw InvalidArgument("unwrap: the period must be a positive number (2*pi for rad, 360 for degrees), but is {}",
                              period);
    Vector y = x;
    for (Index k = 1; k < x.size(); ++k) y[k] = y[k - 1] + smallest_step(x[k] - x[k - 1], period);
    return y;
}

}  // namespace dynlab::inline numerics
