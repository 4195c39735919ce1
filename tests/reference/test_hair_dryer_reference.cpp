#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/srivc.h"
#include "numerics/signals/preprocess.h"
#include "support/hair_dryer.h"

namespace test_hair_dryer_reference {

using namespace dynlab;
using namespace dynlab::test;

/// The first 500 samples, their own means removed.
IdData first_half() {
    const IdData all = hair_dryer();
    return remove_mean(
        IdData(Matrix(all.experiments[0].y.topRows(500)), Matrix(all.experiments[0].u.topRows(500)), all.Ts));
}

Fit optimum(int poles, double delay) {
    FitOptions options;
    options.tolerance = 1e-10;
    return coe(first_half(), TransferStructure::single(poles, 0, delay), options);
}

void expect_digits(const Fit& found, const Vector& published, double fit) {
    ASSERT_EQ(found.theta.size(), published.size());
    for (Index i = 0; i < published.size(); ++i) EXPECT_NEAR(found.theta[i], published[i], 0.51e-4) << i;
    EXPECT_NEAR(found.fit_percent[0], fit, 0.51e-2);
}

// Oracle: output-error optima computed by another program (held input, zero initial state).
TEST(hair_dryer_reference, two_poles_after_two_samples) {
    const Fit found = optimum(2, 0.16);
    expect_digits(found, Eigen::Vector3d(11.8728, 30.5013, 28.2254), 89.01);
    EXPECT_NEAR(1 - std::pow(1 - found.fit_percent[0] / 100, 2), 0.98794, 0.51e-4);
}

TEST(hair_dryer_reference, one_pole_after_three_samples) {
    expect_digits(optimum(1, 0.24), Eigen::Vector2d(2.8200, 2.6316), 84.28);
}

}  // namespace test_hair_dryer_reference
