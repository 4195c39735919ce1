#pragma once
#include "numerics/simulation/closed_loop.h"
#include "support/transfer_cases.h"

namespace dynlab::test {

constexpr double kLoopTs = 0.05;

/// 2/(s^2 + 4s + 3) under the sampled controller 4 + 2 Ts/(z - 1), which answers one sample late.
inline TransferFunction loop_plant() {
    return {values({2}), values({1, 4, 3})};
}
inline LoopController loop_controller() {
    return {TransferFunction(values({4, -3.9}), values({1, -1}), kLoopTs), 1};
}

/// With a prbs reference of 635 samples and noise v of the color 1/(1 - 0.9/q), white e of standard deviation `sigma`.
inline IdData loop_data(double sigma, std::uint32_t seed) {
    const Vector r = prbs(7, 5);
    RandomStream random(seed);
    Vector v = sigma * random.normal(r.size());
    for (Index k = 1; k < v.size(); ++k) v[k] += 0.9 * v[k - 1];
    return ClosedLoop(loop_plant(), loop_controller(), kLoopTs).simulate(r, v);
}

/// 2/((s - 1)(s + 4)), which a sampled gain of 8 holds, with white noise of standard deviation `sigma`.
inline LoopController holding_controller() {
    return {TransferFunction(values({8}), values({1}), kLoopTs)};
}
inline IdData held_input_data(double sigma, std::uint32_t seed) {
    const Vector r = prbs(7, 5);
    return ClosedLoop(TransferFunction(values({2}), values({1, 3, -4})), holding_controller(), kLoopTs)
        .simulate(r, sigma * RandomStream(seed).normal(r.size()));
}

}  // namespace dynlab::test
