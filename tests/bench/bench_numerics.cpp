#include "bench/bench.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::bench {
namespace {

/// lsim of a second-order system at N = 1e7 against reading u and writing y once (a scaled copy).
Result measure_lsim() {
    constexpr Index kSamples = 10'000'000;
    const TransferFunction G(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = RandomStream(1).uniform(kSamples);
    double check = 0;
    const auto simulate = [&] { check += lsim(G, u, 0.01)[kSamples - 1]; };
    const auto copy = [&] {
        const Vector y = 2.0 * u;
        check += y[kSamples - 1];
    };
    const auto [measured, reference] = paired_medians(7, simulate, copy);
    if (check == 0) throw std::logic_error("the simulation was not made");
    return {"lsim, 2 poles, N = 1e7 (s)", "one read of u and write of y (s)", measured, reference, 10, 3};
}

}  // namespace

void measure_numerics(std::vector<Result>& results) {
    results.push_back(measure_lsim());
}

}  // namespace dynlab::bench
