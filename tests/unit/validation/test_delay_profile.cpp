// Oracle: fits with each delay held, from independent starts and from the results at the neighboring delays.
#include "numerics/validation/delay_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "numerics/error.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/srivc.h"
#include "support/transfer_cases.h"

namespace test_delay_profile {

using namespace dynlab;
using namespace dynlab::test;

/// Two resonances, so that far from its delay a model has several minima; 4 % noise.
IdData resonant_data() {
    const Vector u = prbs(8, 4);
    const TransferFunction G(values({-1200, 300, 2400}), values({1, 8, 110, 200, 600}), 0, 0.1);
    const Vector x = lsim(G, u, 0.05);
    const double size = std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
    return IdData(Matrix(x + 0.04 * size * RandomStream(8).normal(x.size())), Matrix(u), 0.05);
}

Vector steps_of(double Ts, Index count) {
    return Vector::LinSpaced(count, 0, Ts * static_cast<double>(count - 1));
}

/// For every delay the smallest loss of srivc and coe from their own starts, then from the solutions of the delays
/// before and behind, there and back, but for swings with fewer than four samples a turn.
Vector held_losses(const IdData& data, int poles, int zeros, const Vector& delays, const FitOptions& options) {
    std::vector<Fit> best;
    const auto at = [&](Index i) { return TransferStructure::single(poles, zeros, delays[i]); };
    const auto offer = [](Fit& known, Fit fit) {
        if (fit.loss < known.loss) known = std::move(fit);
    };
    for (Index i = 0; i < delays.size(); ++i) {
        best.push_back(srivc(data, at(i), options));
        offer(best.back(), coe(data, at(i), options));
    }
    const auto follow = [&](Index i, Index from) {
        const SearchAids aids{best[static_cast<std::size_t>(from)].theta, {}, {}};
        Fit fit = srivc(data, at(i), options, aids);
        if (fit.models[0].poles().imag().maxCoeff() * data.Ts < std::numbers::pi / 2)
            offer(best[static_cast<std::size_t>(i)], std::move(fit));
    };
    for (Index i = 1; i < delays.size(); ++i) follow(i, i - 1);
    for (Index i = delays.size() - 1; i-- > 0;) follow(i, i + 1);
    Vector losses(delays.size());
    for (Index i = 0; i < delays.size(); ++i) losses[i] = best[static_cast<std::size_t>(i)].loss;
    return losses;
}

void expect_profile(const IdData& data, int poles, int zeros, const Vector& delays) {
    FitOptions options = FitOptions().from_rest();
    options.stable = true;
    const TransferStructure structure = TransferStructure::single(poles, zeros);
    const Vector profile = delay_profile(data, structure, {InitialState::kZero, false}, delays, options, 1);
    const Vector held = held_losses(data, poles, zeros, delays, options);
    for (Index i = 0; i < delays.size(); ++i)
        EXPECT_NEAR(profile[i], held[i], 0.01 * held[i]) << "{" << poles << ", " << zeros << "} at " << delays[i];
}

TEST(delay_profile, is_the_best_fit_with_each_delay_held) {
    expect_profile(delayed_data(), 2, 0, steps_of(0.1, 30));
    expect_profile(delayed_data(), 3, 1, steps_of(0.1, 30));
    expect_profile(resonant_data(), 3, 1, steps_of(0.05, 24));
}

TEST(delay_profile, a_start_condition_holds_for_all_delays) {  // oracle: what the output has more, whatever the delay
    IdData data = delayed_data();
    const Vector delays = steps_of(0.1, 12);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Vector centered = delay_profile(data, structure, {InitialState::kZero, true}, delays, {}, 1);
    data.experiments.front().y.array() += 7;
    const Vector lifted = delay_profile(data, structure, {InitialState::kZero, true}, delays, {}, 1);
    for (Index i = 0; i < delays.size(); ++i) EXPECT_NEAR(lifted[i], centered[i], 1e-3 * centered[i]) << delays[i];
}

TEST(delay_profile, several_channels_are_refused) {
    IdData two = delayed_data();
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.inputs = 2;
    structure.channels.push_back(structure.channels.front());
    EXPECT_THROW(delay_profile(two, structure, {InitialState::kZero, false}, steps_of(0.1, 3), {}, 1), InvalidArgument);
}

}  // namespace test_delay_profile
