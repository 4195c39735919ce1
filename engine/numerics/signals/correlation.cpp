#include "numerics/signals/correlation.h"

#include <array>
#include <complex>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDirectLags = 100;  // about where the transforms become the faster way

constexpr Index kLanes = 8, kLagsAtOnce = 4;
constexpr Index kCachedSamples = 2048;  // samples that stay in the processor's cache while all lags pass over them

/// sum over k of x(k + lag) y(k) for four neighbouring lags from that of x's first sample on; x holds three more.
Eigen::Array4d four_lags(const double* x, const double* y, Index count) {
    using Lanes = Eigen::Array<double, kLanes, 1>;
    std::array<Lanes, kLagsAtOnce> sums;
    sums.fill(Lanes::Zero());
    Index k = 0;
    for (; k + kLanes <= count; k += kLanes) {
        const Lanes now = Eigen::Map<const Lanes>(y + k);
        for (Index j = 0; j < kLagsAtOnce; ++j)
            sums[static_cast<std::size_t>(j)] += Eigen::Map<const Lanes>(x + k + j) * now;
    }
    Eigen::Array4d totals;
    for (Index j = 0; j < kLagsAtOnce; ++j) totals[j] = sums[static_cast<std::size_t>(j)].sum();
    for (; k < count; ++k)
        for (Index j = 0; j < kLagsAtOnce; ++j) totals[j] += x[k + j] * y[k];
    return totals;
}

/// sum_k x(k + lag) y(k), lags 0..last, over all k for which both exist.
Vector products_ahead(const VectorView& x, const VectorView& y, Index last) {
    const Index N = x.size(), groups = last / kLagsAtOnce + 1;
    const Index inner = std::max<Index>(0, N - groups * kLagsAtOnce);  // where x has a sample at every lag
    Vector sums = Vector::Zero(groups * kLagsAtOnce);
    for (Index k = 0; k < inner; k += kCachedSamples)
        for (Index lag = 0; lag <= last; lag += kLagsAtOnce)
            sums.segment<kLagsAtOnce>(lag).array() +=
                four_lags(x.data() + k + lag, y.data() + k, std::min(kCachedSamples, inner - k));
    for (Index lag = 0; lag <= std::min(last, N - 1); ++lag)
        if (const Index rest = N - lag - inner; rest > 0) sums[lag] += x.tail(rest).dot(y.segment(inner, rest));
    return sums.head(last + 1);
}

Vector direct_products(const VectorView& x, const VectorView& y, Index lags) {
    Vector sums(2 * lags + 1);
    sums.tail(lags + 1) = products_ahead(x, y, lags);
    const bool same = x.data() == y.data();
    sums.head(lags + 1) = (same ? sums.tail(lags + 1) : products_ahead(y, x, lags)).reverse().eval();
    return sums;
}

std::vector<double> padded(const VectorView& x, std::size_t length) {
    std::vector<double> values(x.begin(), x.end());
    values.resize(length, 0.0);
    return values;
}

/// The next length that is four times a product of twos, threes and fives, for which transforms are fast.
std::size_t transform_length(std::size_t least) {
    for (std::size_t quarter = (least + 3) / 4;; ++quarter) {
        std::size_t rest = quarter;
        for (const std::size_t prime : {2u, 3u, 5u})
            while (rest % prime == 0) rest /= prime;
        if (rest == 1) return 4 * quarter;
    }
}

Vector transformed_products(const VectorView& x, const VectorView& y, Index lags) {
    const Index N = x.size(), reach = std::min(lags, N - 1);
    const std::size_t length = transform_length(static_cast<std::size_t>(N + reach));
    Eigen::FFT<double> transform;
    transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    std::vector<std::complex<double>> X, Y;
    transform.fwd(X, padded(x, length));
    if (x.data() != y.data()) transform.fwd(Y, padded(y, length));
    const std::vector<std::complex<double>>& other = x.data() == y.data() ? X : Y;
    for (std::size_t i = 0; i < X.size(); ++i) X[i] *= std::conj(other[i]);
    std::vector<double> circular;
    transform.inv(circular, X, static_cast<Eigen::Index>(length));
    Vector sums = Vector::Zero(2 * lags + 1);
    for (Index lag = -reach; lag <= reach; ++lag)
        sums[lags + lag] = circular[lag >= 0 ? static_cast<std::size_t>(lag) : length - static_cast<std::size_t>(-lag)];
    return sums;
}

}  // namespace

Vector products_behind(const VectorView& x, const double* y, Index last) {
    const Index N = x.size();
    Vector sums = Vector::Zero(last + 1);
    for (Index k = 0; k < N; k += kCachedSamples) {
        const Index count = std::min(kCachedSamples, N - k);
        Index lag = 0;
        for (; lag + kLagsAtOnce <= last + 1; lag += kLagsAtOnce)
            sums.segment<kLagsAtOnce>(lag).array() +=
                four_lags(y + k - lag - (kLagsAtOnce - 1), x.data() + k, count).reverse();
        for (; lag <= last; ++lag) sums[lag] += Eigen::Map<const Vector>(y + k - lag, count).dot(x.segment(k, count));
    }
    return sums;
}

Vector lagged_products(const VectorView& x, const VectorView& y, Index lags) {
    if (x.size() != y.size() || x.size() == 0)
        throw InvalidArgument("A correlation needs two signals of equal length, and these have " +
                              std::to_string(x.size()) + " and " + std::to_string(y.size()) + " samples");
    if (lags < 0) throw InvalidArgument("The number of lags must not be negative, and is " + std::to_string(lags));
    return lags <= kDirectLags ? direct_products(x, y, lags) : transformed_products(x, y, lags);
}

}  // namespace dynlab::inline numerics
