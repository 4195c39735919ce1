#include "numerics/statistics/lagged_sums.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cstdlib>

#include "numerics/signals/correlation.h"

namespace dynlab::inline numerics {

namespace {

// c(|i - j|), 0 beyond the lags that c has.
Matrix symmetric_toeplitz(const VectorView& c, Index size) {
    Matrix P = Matrix::Zero(size, size);
    for (Index i = 0; i < size; ++i)
        for (Index j = 0; j < size; ++j)
            if (std::abs(i - j) < c.size()) P(i, j) = c[std::abs(i - j)];
    return P;
}

// V is the input shifted by a = 0..L within the data, and T its part beyond the end (L rows). F = [V; T] is complete,
// and F' R F is the Toeplitz matrix of N g, R being that of Re. Z = [R F] in the rows of T gives the result, V' R V =
// F' R F - Z'T - T'Z + T' R T. The mean of e subtracts another V'1 1'V sum(Re)/N, where 1'V = -1'T.
struct BeyondEnd {
    Matrix T, Z;
};

BeyondEnd beyond_end(const VectorView& Re, const VectorView& u, Index lags) {
    const Index reach = Re.size() / 2, N = u.size();
    BeyondEnd beyond{Matrix::Zero(lags, lags + 1), Matrix::Zero(lags, lags + 1)};
    for (Index ahead = 1 - lags; ahead <= lags; ++ahead) {  // of the last sample
        const Index at = N - 1 + ahead, first = std::max<Index>(0, at - reach);
        const Index count = std::min(N - 1, at + reach) - first + 1;
        const double filtered = count > 0 ? Re.segment(reach + first - at, count).dot(u.segment(first, count)) : 0;
        const double moved = ahead <= 0 && at >= 0 ? u[at] : 0;
        for (Index row = std::max<Index>(0, ahead - 1); row < lags && row + 1 - ahead <= lags; ++row) {
            beyond.Z(row, row + 1 - ahead) = filtered;
            beyond.T(row, row + 1 - ahead) = moved;
        }
    }
    return beyond;
}

}  // namespace

Matrix lagged_sum_covariance(const VectorView& g, const VectorView& Re, const std::vector<Vector>& u) {
    const Index lags = g.size() - 1;
    const Matrix R = symmetric_toeplitz(Re.tail(Re.size() / 2 + 1), lags);
    Matrix ends = Matrix::Zero(lags + 1, lags + 1);
    double N = 0;
    for (const Vector& data_set : u) {
        const auto [T, Z] = beyond_end(Re, data_set, lags);
        const Eigen::RowVectorXd sums = T.colwise().sum();
        const auto samples = static_cast<double>(data_set.size());
        ends += Z.transpose() * T + T.transpose() * Z - T.transpose() * R * T +
                Re.sum() / samples * sums.transpose() * sums;
        N += samples;
    }
    return symmetric_toeplitz(g, lags + 1) - ends / N;
}

double explained_part_upper_tail(double part, double directions, double dimension) {
    using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    if (directions <= 0 || dimension <= directions) return 1;
    return boost::math::ibetac(directions / 2, (dimension - directions) / 2, std::clamp(part, 0.0, 1.0), Policy());
}

double total_size(const std::vector<Vector>& data_sets) {
    double N = 0;
    for (const Vector& x : data_sets) N += static_cast<double>(x.size());
    return N;
}

Vector lagged_covariances(const std::vector<Vector>& x, const std::vector<Vector>& y, Index lags) {
    Vector sums = Vector::Zero(2 * lags + 1);
    for (std::size_t i = 0; i < x.size(); ++i) sums += lagged_products(x[i], y[i], lags);
    return sums / total_size(x);
}

}  // namespace dynlab::inline numerics
