#include "numerics/rigs/sensor.h"

#include <cmath>

namespace dynlab::inline numerics {

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
