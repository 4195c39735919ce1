#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/fit/first_estimate.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/signals/random.h"
#include "support/transfer_cases.h"

namespace test_first_estimate {

using namespace dynlab;
using namespace dynlab::test;

// Oracle: the passes from each of thirty cut-off frequencies, to their end.
TEST(first_estimate, the_best_cutoff_leads_to_the_lowest_of_all_ends) {
    struct System {
        TransferFunction G;
        TransferStructure structure;
        double noise;  // over the output's own size
    };
    const System systems[] = {
        {TransferFunction(values({2}), values({1, 4, 3})), TransferStructure::single(2, 0), 1},
        {TransferFunction(values({-6400, 1600}), values({1, 5, 408, 416, 1600})), TransferStructure::single(4, 1), 0.3},
        {TransferFunction(values({1}), values({1, 0.2, 100})), TransferStructure::single(2, 0), 0.03},
        {TransferFunction(values({100, 1}), values({2000, 210, 1})), TransferStructure::single(2, 1), 0.1}};
    const Index N = 1500;
    const double Ts = 0.02;
    for (const System& system : systems) {
        const Vector u = prbs(9, 7).head(N), x = lsim(system.G, u, Ts);
        const double size = std::sqrt(x.squaredNorm() / static_cast<double>(N));
        const IdData data(Matrix(x + system.noise * size * RandomStream(6).normal(N)), Matrix(u), Ts);
        const auto end = [&](const Vector& start) {
            return simulation_loss(data, system.structure, iterate_srivc(data, system.structure, start, {}));
        };
        double lowest = kInfinity;
        for (int i = 0; i < 30; ++i) {
            const double lambda = 0.15 * std::pow(600, i / 29.0);
            lowest = std::min(lowest, end(lssvf_start(data, system.structure, lambda, Hold::kFoh)));
        }
        for (const CutoffTrials trials : {CutoffTrials::kValleys, CutoffTrials::kAll})
            EXPECT_LT(end(best_cutoff_start(data, system.structure, {}, trials)), 1.0001 * lowest);
    }
}

TEST(first_estimate, a_beginning_is_a_record_from_rest) {  // oracle: the samples themselves
    Matrix u = RandomStream(3).normal(600);
    const IdData data(Matrix(RandomStream(4).normal(600)), std::move(u), 0.05);
    const IdData beginning = beginning_of(data, 100);
    ASSERT_EQ(beginning.sample_count(), 100);
    EXPECT_EQ(beginning.experiments[0].y, Matrix(data.experiments[0].y.topRows(100)));
    EXPECT_EQ(beginning_of(data, 1000).sample_count(), 600);
}

}  // namespace test_first_estimate
