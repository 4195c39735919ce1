#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "numerics/error.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/cramer_rao.h"

namespace test_cramer_rao {

using namespace dynlab;
using testing::ElementsAre;

const TransferFunction kSecondOrder(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});

TEST(cramer_rao, published_bound_of_the_second_order_system) {
    // Oracle: the published bound at 10 dB for prbs(7, 8), 1016 samples, Ts = 0.05 s: b0 .076, a1 .162, a2 .103.
    const Vector u = prbs(7, 8), x = lsim(kSecondOrder, u, 0.05);
    const double sigma = std::sqrt((x.array() - x.mean()).square().mean() / 10);
    const Matrix bound = cramer_rao_bound(kSecondOrder, u, 0.05, Hold::kZoh, sigma, {"a1", "a2", "b0"});
    EXPECT_NEAR(std::sqrt(bound(0, 0)), 0.162, 0.0005);
    EXPECT_NEAR(std::sqrt(bound(1, 1)), 0.103, 0.0005);
    EXPECT_NEAR(std::sqrt(bound(2, 2)), 0.076, 0.0005);
}

TEST(cramer_rao, agrees_with_differences_of_simulations) {  // oracle: second route, central differences
    const Vector u = prbs(6, 7);
    const double Ts = 0.1;
    const auto system = [](const Vector& theta) {
        return TransferFunction(Vector{{theta[2], theta[3]}}, Vector{{1, theta[0], theta[1]}}, 0, theta[4]);
    };
    const Vector truth{{1.5, 2, 0.5, 3, 0.33}};
    const std::vector<std::string> names = {"a1", "a2", "b0", "b1", "Td"};
    Matrix psi(u.size(), 5);
    for (Index i = 0; i < 5; ++i) {
        const Vector step = Vector::Unit(5, i) * 1e-5;
        psi.col(i) = (lsim(system(truth + step), u, Ts) - lsim(system(truth - step), u, Ts)) / 2e-5;
    }
    const Matrix expected = 0.04 * (psi.transpose() * psi).inverse();
    const Matrix bound = cramer_rao_bound(system(truth), u, Ts, Hold::kZoh, 0.2, names);
    EXPECT_LT((bound - expected).norm(), 1e-6 * expected.norm());
}

TEST(cramer_rao, truth_belongs_to_structures_that_hold_the_system) {  // oracle: the definition
    EXPECT_THAT(system_parameter_names(kSecondOrder.with_delay(0.5)), ElementsAre("a1", "a2", "b0", "Td"));
    EXPECT_THAT(true_parameters(kSecondOrder, {"a1", "a2", "b0"}), ElementsAre(4, 3, 2));
    EXPECT_THAT(true_parameters(kSecondOrder, {"a1", "a2", "b0", "b1"}), ElementsAre(4, 3, 0, 2));
    EXPECT_THAT(true_parameters(kSecondOrder.with_delay(0.5), {"a1", "a2", "b0", "Td"}), ElementsAre(4, 3, 2, 0.5));
    EXPECT_EQ(true_parameters(kSecondOrder, {"a1", "a2", "a3", "b0"}).size(), 0);
    EXPECT_EQ(true_parameters(kSecondOrder, {"a1", "b0", "a2"}).size(), 0);
    EXPECT_EQ(true_parameters(kSecondOrder, {"Kp", "Tp1"}).size(), 0);
}

TEST(cramer_rao, infinite_where_the_input_has_no_information) {  // oracle: a zero input has no information
    const Matrix bound = cramer_rao_bound(kSecondOrder, Vector::Zero(50), 0.1, Hold::kZoh, 1, {"a1", "a2", "b0"});
    EXPECT_TRUE((bound.diagonal().array() == std::numeric_limits<double>::infinity()).all());
}

TEST(cramer_rao, refuses_what_it_cannot_know) {
    const Vector u = prbs(4, 2);
    EXPECT_THROW(cramer_rao_bound(kSecondOrder, u, 0.1, Hold::kZoh, 1, {"Kp"}), InvalidArgument);
    EXPECT_THROW(cramer_rao_bound(kSecondOrder, u.head(2), 0.1, Hold::kZoh, 1, {"a1", "a2", "b0"}), InvalidArgument);
    const TransferFunction jumps(Vector{{1.0, 1.0}}, Vector{{1.0, 2.0}}, 0, 0.1);
    EXPECT_THROW(cramer_rao_bound(jumps, u, 0.1, Hold::kZoh, 1, {"a1", "b0", "b1", "Td"}), InvalidArgument);
}

}  // namespace test_cramer_rao
