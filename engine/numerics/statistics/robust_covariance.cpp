#include "numerics/statistics/robust_covariance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/statistics/autoregression.h"

namespace dynlab::inline numerics {

namespace {

void check_sizes(const MatrixView& H, const MatrixView& Z, const VectorView& e, const std::vector<Index>& lengths,
                 Index outputs) {
    const Index N = Z.rows(), d = Z.cols();
    if (e.size() != N || H.rows() != d || H.cols() != d)
        throw InvalidArgument("A robust covariance of {} and {} needs one residual for each sample, but got {}",
                              plural(N, "{} sample", "{} samples"), plural(d, "{} parameter", "{} parameters"),
                              e.size());
    if (N <= d)
        throw InvalidArgument("A robust covariance needs more samples than parameters, but got {} and {}",
                              plural(N, "{} sample", "{} samples"), plural(d, "{} parameter", "{} parameters"));
    if (outputs * std::accumulate(lengths.begin(), lengths.end(), Index{0}) != N)
        throw InvalidArgument("The lengths of the experiments of {} must add up to the {} samples",
                              plural(outputs, "{} output", "{} outputs"), N);
}

// v(k) = H sum_i x_i(k) w_i(k), one row for each instant: output by output whitened errors and what takes the place of
// the instruments then.
Matrix weighted_innovations(const MatrixView& H, const MatrixView& Z, const VectorView& e,
                            const std::vector<Index>& lengths, std::vector<Autoregression>& whitening) {
    const Index outputs = static_cast<Index>(whitening.size()), instants = Z.rows() / outputs;
    Matrix V = Matrix::Zero(instants, Z.cols());
    for (Index i = 0; i < outputs; ++i) {
        const auto errors = e.segment(i * instants, instants);
        Autoregression& model = whitening[static_cast<std::size_t>(i)];
        model = fit_autoregression(errors, lengths, highest_autoregressive_order(instants));
        const Matrix X = colored_backwards(model, Z.middleRows(i * instants, instants), lengths);
        V += whitened(model, errors, lengths).asDiagonal() * X;
    }
    return V * H.transpose();
}

// Lag-one correlations of the columns of V, no closer to one than Andrews advises.
Vector lag_one_correlations(const Matrix& V, const std::vector<Index>& lengths) {
    constexpr double kMaxValue = 0.97;
    Vector correlations(V.cols());
    for (Index i = 0; i < V.cols(); ++i) {
        double products = 0;
        Index first = 0;
        for (const Index length : lengths) {
            const auto v = V.col(i).segment(first, length);
            if (length > 1) products += v.tail(length - 1).dot(v.head(length - 1));
            first += length;
        }
        const double power = V.col(i).squaredNorm();
        correlations[i] = power > 0 ? std::clamp(products / power, -kMaxValue, kMaxValue) : 0;
    }
    return correlations;
}

Index bartlett_bandwidth(const Vector& rho, Index N, Index longest) {
    const auto square = rho.array().square();
    const double alpha = (4 * square / (1 - square).square()).mean();
    const double L = std::ceil(1.1447 * std::cbrt(alpha * static_cast<double>(N)));
    return std::clamp<Index>(static_cast<Index>(L), 1, std::max<Index>(1, longest / 2));
}

// sum_|l|<L (1 - |l|/L) sum_k v(k) v(k-l)' = (1/L) sum of s s' over all sums s of up to L neighboring rows.
Matrix bartlett_sum(const Eigen::Ref<const Matrix>& V, Index L) {
    const Index N = V.rows();
    Matrix sum = Matrix::Zero(V.cols(), V.cols());
    Vector moving = Vector::Zero(V.cols());
    for (Index k = 0; k < N + L - 1; ++k) {
        if (k < N) moving += V.row(k).transpose();
        if (k >= L) moving -= V.row(k - L).transpose();
        sum.noalias() += moving * moving.transpose();
    }
    return sum / static_cast<double>(L);
}

}  // namespace

RobustCovariance robust_covariance(const MatrixView& H, const MatrixView& Z, const VectorView& e,
                                   const std::vector<Index>& given_lengths, Index outputs) {
    const std::vector<Index> lengths = given_lengths.empty() ? std::vector<Index>{Z.rows() / outputs} : given_lengths;
    check_sizes(H, Z, e, lengths, outputs);
    const Index N = Z.rows(), d = Z.cols();
    RobustCovariance result;
    result.whitening.resize(static_cast<std::size_t>(outputs));
    const Matrix V = weighted_innovations(H, Z, e, lengths, result.whitening);
    result.bandwidth = bartlett_bandwidth(lag_one_correlations(V, lengths), V.rows(),
                                          *std::max_element(lengths.begin(), lengths.end()));
    result.covariance = Matrix::Zero(d, d);
    Index first = 0;
    for (const Index length : lengths) {
        result.covariance += bartlett_sum(V.middleRows(first, length), result.bandwidth);
        first += length;
    }
    result.covariance *= static_cast<double>(N) / static_cast<double>(N - d);
    result.std = result.covariance.diagonal().cwiseSqrt();
    return result;
}

namespace {

/// Of errors of one size: H X'X H times their mean square, x the instruments colored backwards.
Vector variances_of_one_size(const Matrix& H, const MatrixView& Psi, const Vector& e, const std::vector<Index>& lengths,
                             const Autoregression& model) {
    const Matrix V = colored_backwards(model, Psi, lengths) * H;
    const auto freedom = static_cast<double>(std::max<Index>(1, Psi.rows() - Psi.cols() - model.order()));
    return whitened(model, e, lengths).squaredNorm() / freedom * V.colwise().squaredNorm().transpose();
}

}  // namespace

RobustCovariance robust_covariance(const MatrixView& Psi, const VectorView& e, const std::vector<Index>& given_lengths,
                                   Index outputs) {
    constexpr double kMin = 0.1;
    constexpr Index kShort = 100;  // samples
    if (Psi.rows() <= Psi.cols())
        throw InvalidArgument("A robust covariance needs more samples than parameters, but got {} and {}",
                              plural(Psi.rows(), "{} sample", "{} samples"),
                              plural(Psi.cols(), "{} parameter", "{} parameters"));
    const Matrix H = solve_least_squares(Psi, e).inverse_gram;
    const Vector leverages = (Psi * H).cwiseProduct(Psi).rowwise().sum();
    const Vector unfitted = e.array() / (1 - leverages.array()).max(kMin);
    RobustCovariance result = robust_covariance(H, Psi, unfitted, given_lengths, outputs);
    if (outputs > 1 || Psi.rows() > kShort) return result;
    const std::vector<Index> lengths = given_lengths.empty() ? std::vector<Index>{Psi.rows()} : given_lengths;
    const Vector least = variances_of_one_size(H, Psi, unfitted, lengths, result.whitening.front());
    const Vector std = result.std.cwiseMax(least.cwiseSqrt());
    const Vector rise = (result.std.array() > 0).select(std.cwiseQuotient(result.std), 1);
    result.covariance = rise.asDiagonal() * result.covariance * rise.asDiagonal();
    result.std = result.covariance.diagonal().cwiseSqrt();
    return result;
}

}  // namespace dynlab::inline numerics
