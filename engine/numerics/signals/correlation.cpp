#include "numerics/signals/correlation.h"

#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDirectLags = 100;  // about where the transforms become the faster way

using Packet = Eigen::internal::packet_traits<double>::type;  // as many values as the processor takes at once
constexpr Index kLanes = sizeof(Packet) / sizeof(double), kShifts = 4;
constexpr Index kCachedSamples = 2048;  // samples that stay in the processor's cache while all lags pass over them

/// Values that stay in a register: compilers read them again for each product, and reading is what takes the time.
Packet read(const double* values) {
    Packet packet = Eigen::internal::ploadu<Packet>(values);
    EIGEN_OPTIMIZATION_BARRIER(packet)
    return packet;
}

/// sum over k of x(k + j) y(k - 4 w) for j = 0..3, the shifts of x, and w = 0, 1, ..., the windows of y: what is read
/// serves several lags. Entry 4 w + j; x holds three more samples, y those before its first that the windows ask for.
template <Index kWindows>
Eigen::Array<double, kShifts * kWindows, 1> shifted_products(const double* x, const double* y, Index count) {
    constexpr Index kLags = kShifts * kWindows;
    Packet sums[kLags];
    for (Packet& sum : sums) sum = Eigen::internal::pset1<Packet>(0);
    Index k = 0;
    for (; k + kLanes <= count; k += kLanes) {
        Packet windows[kWindows];
        for (Index w = 0; w < kWindows; ++w) windows[w] = read(y + k - kShifts * w);
        for (Index j = 0; j < kShifts; ++j) {
            const Packet shifted = read(x + k + j);
            for (Index w = 0; w < kWindows; ++w)
                sums[kShifts * w + j] = Eigen::internal::pmadd(shifted, windows[w], sums[kShifts * w + j]);
        }
    }
    Eigen::Array<double, kLags, 1> totals;
    for (Index i = 0; i < kLags; ++i) totals[i] = Eigen::internal::predux(sums[i]);
    for (; k < count; ++k)
        for (Index i = 0; i < kLags; ++i) totals[i] += x[k + i % kShifts] * y[k - i / kShifts * kShifts];
    return totals;
}

/// sum_k x(k + lag) y(k), lags 0..last, over all k for which both exist.
Vector products_ahead(const VectorView& x, const VectorView& y, Index last) {
    constexpr Index kWindows = 2, kLagsAtOnce = kShifts * kWindows, kBefore = kLagsAtOnce - kShifts;
    const Index N = x.size(), groups = last / kLagsAtOnce + 1;
    const Index end = std::max(kBefore, N - groups * kLagsAtOnce);  // until there x has a sample at every lag
    Vector sums = Vector::Zero(groups * kLagsAtOnce);
    for (Index k = kBefore; k < end; k += kCachedSamples)
        for (Index lag = 0; lag <= last; lag += kLagsAtOnce)
            sums.segment<kLagsAtOnce>(lag).array() +=
                shifted_products<kWindows>(x.data() + k + lag, y.data() + k, std::min(kCachedSamples, end - k));
    // At a lag of the w-th window these were the samples kBefore - 4 w to end - 4 w of y.
    for (Index lag = 0; lag <= std::min(last, N - 1); ++lag) {
        const Index behind = lag % kLagsAtOnce / kShifts * kShifts, pairs = N - lag;
        const Index begin = std::min(pairs, kBefore - behind), rest = std::max<Index>(0, pairs - (end - behind));
        sums[lag] += x.segment(lag, begin).dot(y.head(begin)) + x.tail(rest).dot(y.segment(pairs - rest, rest));
    }
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
        for (; lag + kShifts <= last + 1; lag += kShifts)
            sums.segment<kShifts>(lag).array() +=
                shifted_products<1>(y + k - lag - (kShifts - 1), x.data() + k, count).reverse();
        for (; lag <= last; ++lag) sums[lag] += Eigen::Map<const Vector>(y + k - lag, count).dot(x.segment(k, count));
    }
    return sums;
}

Vector lagged_products(const VectorView& x, const VectorView& y, Index lags) {
    if (x.size() != y.size() || x.size() == 0)
        throw InvalidArgument("A correlation needs two signals of equal length, but these have {} and {} samples",
                              x.size(), y.size());
    if (lags < 0) throw InvalidArgument("The number of lags must be nonnegative, but is {}", lags);
    return lags <= kDirectLags ? direct_products(x, y, lags) : transformed_products(x, y, lags);
}

}  // namespace dynlab::inline numerics
