#include "numerics/plants/plant_data.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/prbs.h"

namespace dynlab::inline numerics {

Vector sampling_instants(double duration, double Ts) {
    // The small surplus keeps the last sample when duration/Ts rounds to just below a whole number.
    const Index steps = static_cast<Index>(std::floor(duration / Ts + 1e-9));
    return Vector::LinSpaced(steps + 1, 0, static_cast<double>(steps)) * Ts;
}

void require_positive(const char* plant, const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
        throw InvalidArgument("The {}'s {} must be positive, but is {}", plant, name, significant(value, 6));
}

void require_not_negative(const char* plant, const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value))
        throw InvalidArgument("The {}'s {} must be nonnegative, but is {}", plant, name, significant(value, 6));
}

Vector seeded_prbs(int stages, int hold, double low, double high, RandomStream& random) {
    const Vector bits = prbs(stages, 1, 0, 1);
    const Index count = bits.size();
    const auto first = static_cast<Index>(std::floor(random.uniform() * static_cast<double>(count)));
    const Index direction = random.uniform() < 0.5 ? 1 : count - 1;
    const bool exchanged = random.uniform() < 0.5;
    Vector u(count * hold);
    for (Index k = 0; k < count; ++k) {
        const bool one = bits[(first + direction * k) % count] > 0.5;
        u.segment(k * hold, hold).setConstant(one != exchanged ? high : low);
    }
    return u;
}

Vector measure(const Vector& truth, double noise_std, double resolution, RandomStream& random) {
    return measure(truth, noise_std, resolution, random.normal(truth.size()));
}

Vector measure(const Vector& truth, double noise_std, double resolution, const Vector& normals) {
    Vector y = truth + noise_std * normals;
    if (resolution > 0)
        for (double& value : y) value = resolution * std::round(value / resolution);
    return y;
}

}  // namespace dynlab::inline numerics
