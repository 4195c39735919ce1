#include "bench/bench.h"
#include "bench/peers.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::bench {
namespace {

/// lsim of a second-order system at N = 1e7 against reading u and writing y once (a scaled copy into memory in use).
void measure_lsim(Report& report) {
    constexpr Index kSamples = 10'000'000;
    const TransferFunction G(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3));
    const Vector u = RandomStream(1).uniform(kSamples);
    Vector y = Vector::Zero(kSamples);
    double check = 0;
    const auto simulate = [&] { check += lsim(G, u, 0.01)[kSamples - 1]; };
    const auto copy = [&] {
        y = 2.0 * u;
        check += y[kSamples - 1];
    };
    const auto [measured, reference] = paired_medians(7, simulate, copy);
    if (check == 0) throw std::logic_error("the simulation was not made");
    report.results.push_back(
        {"lsim, 2 poles, N = 1e7 (s)", "one read of u and write of y (s)", measured, reference, 3, 2});
    const auto last = [&] { return Vector(lsim(G, u, 0.01).tail(1)); };
    compare_with_peer({"lsim, 2 poles, N = 1e7 (s)", Peer::kNumpy, "lsim", 1, 0}, {u, y}, last, report);
}

}  // namespace

void measure_numerics(Report& report) {
    measure_lsim(report);
}

}  // namespace dynlab::bench
