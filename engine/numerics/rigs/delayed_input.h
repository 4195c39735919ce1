#pragma once
#include <algorithm>
#include <cmath>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Calls advance(value, duration) for the pieces of sampling interval k, from k Ts to (k + 1) Ts, over which the held
/// input u, delayed by `delay` (s, any), is constant. Before its first sample u has the value of that sample.
template <class Advance>
void over_interval(const Vector& u, Index k, double delay, double Ts, Advance advance) {
    const auto whole = static_cast<Index>(std::floor(delay / Ts + 1e-9));
    const double part = std::max(0., delay - static_cast<double>(whole) * Ts);
    const auto value = [&](Index i) { return u[std::max<Index>(i, 0)]; };
    if (part > 0) advance(value(k - whole - 1), part);
    advance(value(k - whole), Ts - part);
}

}  // namespace dynlab::inline numerics
