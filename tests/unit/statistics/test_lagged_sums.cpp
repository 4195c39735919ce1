#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/random.h"
#include "numerics/statistics/lagged_sums.h"

namespace test_lagged_sums {

using namespace dynlab;

Vector centered(Vector x) {
    x.array() -= x.mean();
    return x;
}

double covariance(const Vector& Re, Index lag) {
    const Index reach = Re.size() / 2;
    return std::abs(lag) <= reach ? Re[reach + lag] : 0;
}

// N times the covariance of (1/N) sum_t e(t) u(t - a), summed pair by pair of instants. The effect of removing the mean
// of e is exact for white e, and otherwise that of long data.
Matrix by_pairs(const Vector& Re, const std::vector<Vector>& data_sets, Index lags) {
    Matrix S = Matrix::Zero(lags + 1, lags + 1);
    double N = 0;
    for (const Vector& u : data_sets) {
        N += static_cast<double>(u.size());
        for (Index a = 0; a <= lags; ++a)
            for (Index b = 0; b <= lags; ++b) {
                double sum_a = 0, sum_b = 0;
                for (Index s = a; s < u.size(); ++s) sum_a += u[s - a];
                for (Index t = b; t < u.size(); ++t) sum_b += u[t - b];
                for (Index s = a; s < u.size(); ++s)
                    for (Index t = b; t < u.size(); ++t) S(a, b) += covariance(Re, s - t) * u[s - a] * u[t - b];
                S(a, b) -= Re.sum() * sum_a * sum_b / static_cast<double>(u.size());
            }
    }
    return S / N;
}

Vector first_row(const Vector& Re, const std::vector<Vector>& data_sets, Index lags) {
    Vector g = Vector::Zero(lags + 1);
    double N = 0;
    for (const Vector& u : data_sets) {
        N += static_cast<double>(u.size());
        for (Index h = 0; h <= lags; ++h)
            for (Index s = 0; s < u.size(); ++s)
                for (Index t = 0; t < u.size(); ++t) g[h] += covariance(Re, s - t - h) * u[s] * u[t];
    }
    return g / N;
}

TEST(lagged_sums, covariance_is_that_of_the_sums) {  // oracle: the definition, pair by pair
    const Vector white = Vector::Constant(1, 0.7), colored{{0.1, -0.3, 0.5, 1.2, 0.5, -0.3, 0.1}};
    Vector slow(61);  // has more lags than the shortest data set
    for (Index k = 0; k < slow.size(); ++k) slow[k] = std::exp(-0.1 * static_cast<double>(std::abs(k - 30)));
    const std::vector<Vector> one{centered(RandomStream(1).normal(20))};
    const std::vector<Vector> several{centered(RandomStream(2).normal(17)), centered(RandomStream(3).normal(4)),
                                      centered(RandomStream(4).normal(30))};
    for (const Vector& Re : {white, colored, slow})
        for (const auto& data_sets : {one, several})
            for (const Index lags : {1, 6, 10}) {
                const Matrix P = lagged_sum_covariance(first_row(Re, data_sets, lags), Re, data_sets);
                const Matrix expected = by_pairs(Re, data_sets, lags);
                EXPECT_LT((P - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.norm()) << lags << " " << Re.size();
            }
}

TEST(lagged_sums, explained_part_of_two_directions) {  // oracle: analytic, P(R^2 > x) = (1 - x)^((n - 2)/2)
    for (const double n : {3.0, 10.0, 101.0})
        for (const double x : {0.0, 0.01, 0.5, 0.99})
            EXPECT_NEAR(explained_part_upper_tail(x, 2, n), std::pow(1 - x, (n - 2) / 2), 1e-14);
    EXPECT_EQ(explained_part_upper_tail(1, 2, 2), 1);
    EXPECT_EQ(explained_part_upper_tail(0.3, 0, 9), 1);
    EXPECT_EQ(explained_part_upper_tail(1.2, 2, 9), 0);
}

}  // namespace test_lagged_sums
