#include "numerics/estimators/recursive/rlssvf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/reader.h"
#include "numerics/estimators/lssvf.h"
#include "support/recursive_cases.h"
#include "support/thrown_message.h"

namespace test_rlssvf {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

TEST(rlssvf, forgetting_nothing_gives_lssvf) {  // oracle: lssvf, on data of all kinds
    for (const RecursiveCase& one : recursive_cases()) {
        const Fit batch = lssvf(one.data, one.structure, cutoff(one.lambda));
        const Fit pass = rlssvf(one.data, one.structure, recursive(one.lambda));
        EXPECT_LT(relative_difference(pass.theta, batch.theta), 1e-8) << one.name;
        EXPECT_LT(relative_difference(pass.std, batch.std), 1e-6) << one.name;
        EXPECT_THAT(message_text(pass.full_message()), HasSubstr("without forgetting"));
    }
}

// oracle: weighted least squares with stored columns from lsim
TEST(rlssvf, forgetting_weighs_old_samples_less) {
    const IdData data = course_system_data(0.1, 3);
    const Vector y = data.experiments[0].y.col(0), u = data.experiments[0].u.col(0);
    const Matrix y_f = state_variable_filter(y, 2, 3, 0.01, Hold::kFoh);
    Matrix Phi(y.size(), 3);
    Phi << -y_f.col(1), -y_f.col(2), lsim(TransferFunction(values({1}), values({1, 6, 9})), u, 0.01);
    RecursiveOptions options = recursive(3);
    options.forgetting = 0.995;
    options.history_points = 4;
    const Fit pass = rlssvf(data, TransferStructure::single(2, 0), options);
    ASSERT_EQ(pass.history->t.size(), 4);
    EXPECT_NEAR(pass.history->t[3], 14.99, 1e-9);
    for (Index point = 0; point < 4; ++point) {
        const Index last = std::lround(pass.history->t[point] / 0.01);
        Vector roots(last + 1);
        for (Index k = 0; k <= last; ++k) roots[k] = std::pow(0.995, double(last - k) / 2);
        const Matrix weighted = roots.asDiagonal() * Phi.topRows(last + 1);
        const Vector expected = weighted.householderQr().solve(roots.cwiseProduct(y_f.col(0).head(last + 1)));
        EXPECT_LT(relative_difference(pass.history->theta.row(point).transpose(), expected), 1e-8) << point;
    }
}

// oracle: the Kalman filter as textbooks write it, on the same columns
TEST(rlssvf, drift_is_a_kalman_filter) {
    const IdData data = course_system_data(0.1, 3);
    const Vector y = data.experiments[0].y.col(0), u = data.experiments[0].u.col(0);
    const Matrix y_f = state_variable_filter(y, 2, 3, 0.01, Hold::kFoh);
    Matrix Phi(y.size(), 3);
    Phi << -y_f.col(1), -y_f.col(2), lsim(TransferFunction(values({1}), values({1, 6, 9})), u, 0.01);
    RecursiveOptions options = recursive(3);
    options.drift = values({1e-4, 0, 1e-5});
    options.noise_variance = 0.02;
    const Fit pass = rlssvf(data, TransferStructure::single(2, 0), options);
    Matrix P = 1e6 * Matrix::Identity(3, 3);
    Vector theta = Vector::Zero(3);
    for (Index k = 0; k < y.size(); ++k) {
        if (k > 0) P += options.drift.asDiagonal();
        const Vector phi = Phi.row(k).transpose(), gain = P * phi / (0.02 + phi.dot(P * phi));
        theta += gain * (y_f(k, 0) - phi.dot(theta));
        P -= gain * (P * phi).transpose();
    }
    EXPECT_LT(relative_difference(pass.theta, theta), 1e-5);
    EXPECT_LT((pass.covariance * (0.02 / pass.noise_variance[0]) - P).norm(), 1e-5 * P.norm());
    EXPECT_THAT(message_text(pass.full_message()), HasSubstr("follow a random"));
}

TEST(rlssvf, follows_a_parameter_that_jumps) {  // oracle: the truth on either side
    const IdData data = jumping_data();
    RecursiveOptions options = recursive(3);
    options.forgetting = 0.97;
    const Fit G = rlssvf(data, TransferStructure::single(1, 0), options);
    const ParameterHistory& history = *G.history;
    const Index N = history.t.size();
    EXPECT_NEAR(history.theta(N / 2 - 20, 1), 2, 0.05);
    EXPECT_NEAR(history.theta(N - 1, 1), 4, 0.05);
    EXPECT_NEAR(history.theta(N - 1, 0), 1, 0.05);
}

TEST(rlssvf, refuses_what_it_cannot_use) {  // oracle: the sentence names method and fault
    const IdData data = course_system_data(0.1, 3);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const auto refused = [&](const IdData& data_set, const TransferStructure& expected_value,
                             const RecursiveOptions& options) {
        return thrown_message([&] { rlssvf(data_set, expected_value, options); });
    };
    RecursiveOptions options = recursive(3);
    for (const double forgetting : {0.0, -0.5, 1.01, std::nan("")}) {
        options.forgetting = forgetting;
        EXPECT_THAT(refused(data, structure, options),
                    HasSubstr("rlssvf: the forgetting factor must be greater than 0"));
    }
    options = recursive(3);
    options.drift = values({1, 2});
    EXPECT_THAT(refused(data, structure, options), HasSubstr("each of the 3 parameters"));
    options.drift = values({1, -2, 1});
    EXPECT_THAT(refused(data, structure, options), HasSubstr("must be nonnegative"));
    EXPECT_THAT(refused(data, structure, recursive(-1)), HasSubstr("lambda"));
    EXPECT_THAT(refused(data.range(1, 5), structure, recursive(3)), HasSubstr("at least 9 samples"));
    EXPECT_THAT(refused(IdData::merge({data, data}), structure, recursive(3)),
                HasSubstr("the data must have one experiment"));
    EXPECT_THAT(refused(data, TransferStructure::single(9, 0), recursive(3)), HasSubstr("up to 8 poles"));
    EXPECT_THAT(refused(data, TransferStructure::single(2, 0, 0.0137), recursive(3)),
                HasSubstr("whole number of sampling times"));
    IdData still = data;
    still.experiments.front().u.setOnes();
    still.experiments.front().y = Vector::LinSpaced(1500, 0, 1);
    EXPECT_THAT(refused(still, TransferStructure::single(5, 4), recursive(3)),
                HasSubstr("do not determine the parameters"));
}

}  // namespace test_rlssvf
