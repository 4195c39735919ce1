#include <gtest/gtest.h>

#include "numerics/estimators/arx.h"
#include "numerics/signals/preprocess.h"
#include "support/hair_dryer.h"

namespace test_arx_reference {

using namespace dynlab;
using namespace dynlab::test;

Fit hair_dryer_model(int nk) {
    return arx(remove_mean(hair_dryer()), PolynomialOrders::arx(2, {2}, {nk}));
}

void expect_values(const Vector& theta, const Vector& published, double tolerance) {
    ASSERT_EQ(theta.size(), published.size());
    for (Index i = 0; i < theta.size(); ++i) EXPECT_NEAR(theta[i], published[i], tolerance) << i;
}

// Oracle: reference values computed by another program for the hair dryer: all 1000 samples, means removed, least
// squares from the first sample whose whole past is recorded (the fifth with nk = 3).
TEST(arx_reference, hair_dryer_with_three_samples_of_delay) {
    expect_values(hair_dryer_model(3).theta, Vector{{-1.28872986, 0.40665869, 0.06551796, 0.04382600}}, 0.51e-8);
}

TEST(arx_reference, hair_dryer_with_two_samples_of_delay) {
    expect_values(hair_dryer_model(2).theta, Vector{{-1.50096, 0.59173, 0.00531, 0.07323}}, 0.51e-5);
}

}  // namespace test_arx_reference
