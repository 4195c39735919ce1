#include <gtest/gtest.h>

#include "numerics/estimators/hammerstein.h"
#include "numerics/simulation/lsim.h"
#include "support/difference_equation.h"
#include "support/transfer_cases.h"

namespace test_hammerstein_properties {

using namespace dynlab;
using namespace dynlab::test;

Fit fit(const Vector& u, const Vector& y, double Ts) {
    HammersteinOptions options;
    options.bins = 4;
    options.tolerance = 1e-10;
    return hammerstein(IdData(Matrix(y), Matrix(u), Ts), TransferStructure::single(1, 0), options);
}

// Oracle: invariance. Units of input, output and time go into edges, levels and poles, and nowhere else.
TEST(hammerstein_properties, units_have_no_say) {
    const Vector draws = RandomStream(1).normal(800);
    Vector u(800);
    for (Index k = 0; k < 800; ++k) u[k] = std::round(2 * draws[k / 5]);
    const Vector y =
        lsim(TransferFunction(values({2}), values({1, 2})), u.cwiseMax(0), 0.1) + 0.05 * RandomStream(2).normal(800);
    const auto one = fit(u, y, 0.1), other = fit(-1e3 * u, 1e4 * y, 0.1 * 60);
    ASSERT_EQ(one.characteristic->levels.size(), other.characteristic->levels.size());
    EXPECT_LT(
        (other.characteristic->breakpoints.reverse() / -1e3 - one.characteristic->breakpoints).cwiseAbs().maxCoeff(),
        1e-12);
    EXPECT_LT((other.characteristic->levels.reverse() / 1e4 - one.characteristic->levels).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR(other.theta[0] * 60 / one.theta[0], 1, 1e-6);
    EXPECT_NEAR(other.fit_percent[0], one.fit_percent[0], 1e-6);
}

}  // namespace test_hammerstein_properties
