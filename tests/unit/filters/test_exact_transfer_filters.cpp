#include <gtest/gtest.h>

#include "numerics/filters/transfer_filters.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_exact_transfer_filters {

using namespace dynlab;

constexpr Index kSamples = 300;
constexpr double kTs = 0.1, kDelay = 0.23;
const Vector kB{{2.0, 3.0}}, kA{{1.0, 1.5, 4.0}};

SampleView view(const Vector& x) {
    return {x.data(), x.size()};
}

/// Increasing instants with unequal steps.
Vector some_instants() {
    Vector t = kTs * Vector::LinSpaced(kSamples, 0, static_cast<double>(kSamples - 1));
    return t + 0.02 * t.array().sin().matrix();
}

TEST(exact_transfer_filters, responses_under_both_samplings) {  // oracle: second route, lsim; central differences
    const Vector u = RandomStream(1).normal(kSamples), t = some_instants();
    const TransferFunction G(kB, kA, 0, kDelay);
    for (const Hold hold : {Hold::kZoh, Hold::kFoh}) {
        const Sampling regular{kTs, {nullptr, 0}}, irregular{0, view(t)};
        const TransferFilters& filters = transfer_filters();
        EXPECT_LT((filters.response(kB, kA, kDelay, u, regular, hold) - lsim(G, u, kTs, hold)).norm(), 1e-10);
        EXPECT_LT((filters.response(kB, kA, kDelay, u, irregular, hold) - lsim(G, u, t, hold)).norm(), 1e-10);
        for (const Sampling& sampling : {regular, irregular}) {
            const Matrix all = filters.sensitivities(kB, kA, kDelay, u, sampling, hold);
            ASSERT_EQ(all.cols(), 6);
            EXPECT_LT((all.col(0) - filters.response(kB, kA, kDelay, u, sampling, hold)).norm(), 1e-10);
            const Vector h = 1e-6 * Vector::Unit(3, 2);
            const Vector difference = filters.response(kB, kA + h, kDelay, u, sampling, hold) -
                                      filters.response(kB, kA - h, kDelay, u, sampling, hold);
            EXPECT_LT((all.col(2) - difference / 2e-6).norm(), 1e-6 * all.col(2).norm());
        }
    }
}

TEST(exact_transfer_filters,
     free_motions_under_both_samplings) {  // oracle: exp(-t) by A = p + 1, its derivative -t exp(-t)
    const Vector A{{1.0, 1.0}}, t = some_instants(), even = kTs * Vector::LinSpaced(kSamples, 0, kSamples - 1.0);
    for (const bool regular : {true, false}) {
        const Sampling sampling{regular ? kTs : 0, regular ? SampleView{nullptr, 0} : view(t)};
        const Vector at = (regular ? even : t).array() - (regular ? 0 : t[0]), motion = (-at).array().exp();
        EXPECT_LT((transfer_filters().free_responses(A, kSamples, sampling).col(0) - motion).norm(), 1e-11);
        const Matrix sensitivities = transfer_filters().free_sensitivities(A, Vector::Ones(1), kSamples, sampling);
        EXPECT_LT((sensitivities.col(0) + at.cwiseProduct(motion)).norm(), 1e-10);
    }
}

TEST(exact_transfer_filters, sums_over_filtered_signals) {  // oracle: second route, lsim filters each signal
    const Vector u = RandomStream(1).normal(kSamples), y = RandomStream(2).normal(kSamples);
    const Vector E{{1.0, 3.0, 2.0}}, one{{1.0}}, p{{1.0, 0.0}}, pp{{1.0, 0.0, 0.0}};
    const RegressionData data_set{view(y), {view(u)}, {1}, {0.2}, {kTs, {nullptr, 0}}, Hold::kZoh, Hold::kFoh};
    const auto filtered = [&](const Vector& num, const Vector& den, const Vector& x, double delay, Hold hold) {
        return lsim(TransferFunction(num, den, 0, delay), x, kTs, hold);
    };
    const TransferFilters& filters = transfer_filters();
    const auto equations = [&](const Vector& filter) {  // [phi, p^2 y_f]
        Matrix all(kSamples, 5);
        all << -filtered(p, filter, y, 0, Hold::kFoh), -filtered(one, filter, y, 0, Hold::kFoh),
            filtered(p, filter, u, 0.2, Hold::kZoh), filtered(one, filter, u, 0.2, Hold::kZoh),
            filtered(pp, filter, y, 0, Hold::kFoh);
        return all;
    };
    const auto near = [](const Matrix& a, const Matrix& b) { return (a - b).norm() < 1e-8 * b.norm(); };

    const Matrix by_E = equations(E), phi_E = by_E.leftCols(4);
    const NormalEquations svf = filters.svf(data_set, E, 2);
    EXPECT_TRUE(near(svf.z_phi, 4 * phi_E.transpose() * phi_E));
    EXPECT_TRUE(near(svf.z_y, 4 * phi_E.transpose() * by_E.col(4)));

    Matrix z = phi_E;
    const Vector x = filtered(kB, kA, u, 0.2, Hold::kZoh);
    z.leftCols(2) << -filtered(p, E, x, 0, Hold::kFoh), -filtered(one, E, x, 0, Hold::kFoh);
    EXPECT_TRUE(near(filters.auxiliary(data_set, E, kA, {kB}, 1).z_phi, z.transpose() * phi_E));

    const Matrix by_A = equations(kA), phi_A = by_A.leftCols(4);
    Matrix psi(kSamples, 4);  // the sensitivities of the simulated output
    psi = filters.sensitivities(kB, kA, 0.2, u, data_set.sampling, Hold::kZoh).middleCols(1, 4);
    const NormalEquations refined = filters.refined(data_set, kA, {kB}, true);
    EXPECT_TRUE(near(refined.z_phi, psi.transpose() * phi_A));
    EXPECT_TRUE(near(refined.z_z, psi.transpose() * psi));
    EXPECT_NEAR(filters.output_error_squares(data_set, {kA}, {kB}) / (y - x).squaredNorm(), 1, 1e-10);
}

}  // namespace test_exact_transfer_filters
