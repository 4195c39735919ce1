#pragma once
#include <algorithm>
#include <cmath>

#include "numerics/linalg/types.h"
#include "numerics/signals/random.h"

namespace dynlab::inline numerics {

/// Data of a plant's experiment: instants (s), inputs and measured outputs, N values each.
struct PlantData {
    Vector t, u, y;
};

/// Instants 0, Ts, ... that cover `duration` (s), both ends included when it is a multiple of Ts.
Vector sampling_instants(double duration, double Ts);

/// Throws InvalidArgument "The PLANT's NAME must be positive (nonnegative), but is VALUE". The names are those of
/// parameters of the C++ structs, which have no translation.
void require_positive(const char* plant, const char* name, double value);
void require_not_negative(const char* plant, const char* name, double value);
/// The same for several: name, value, name, value, ... The first of them that is refused is reported.
template <class... More>
void require_positive(const char* plant, const char* name, double value, More... more) {
    require_positive(plant, name, value);
    require_positive(plant, more...);
}
template <class... More>
void require_not_negative(const char* plant, const char* name, double value, More... more) {
    require_not_negative(plant, name, value);
    require_not_negative(plant, more...);
}

/// A pseudo-random binary sequence as an experimenter with another seed would apply it: one period of prbs(stages,
/// hold) that begins at a random bit, runs forwards or backwards and has a random sign (three uniform draws). Every one
/// has the same spectrum; no two seeds give the same order of bits, few exceptions apart.
Vector seeded_prbs(int stages, int hold, double low, double high, RandomStream& random);

/// A plant's sensor: white normal noise of standard deviation `noise_std`, then rounding to whole multiples of
/// `resolution` (none when 0).
Vector measure(const Vector& truth, double noise_std, double resolution, RandomStream& random);
/// The same with the noise's numbers, of standard deviation one, drawn before.
Vector measure(const Vector& truth, double noise_std, double resolution, const Vector& normals);

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
