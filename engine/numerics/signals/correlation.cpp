#include "numerics/signals/correlation.h"

#include <complex>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kDirectLags = 100;  // about where the transforms become the faster way

Vector direct_products(const VectorView& x, const VectorView& y, Index lags) {
    const Index N = x.size();
    Vector sums = Vector::Zero(2 * lags + 1);
    for (Index lag = 0; lag <= std::min(lags, N - 1); ++lag) {
        sums[lags + lag] = x.tail(N - lag).dot(y.head(N - lag));
        sums[lags - lag] = x.head(N - lag).dot(y.tail(N - lag));
    }
    return sums;
}

std::vector<double> padded(const VectorView& x, std::size_t length) {
    std::vector<double> values(x.begin(), x.end());
    values.resize(length, 0.0);
    return values;
}

Vector transformed_products(const VectorView& x, const VectorView& y, Index lags) {
    const Index N = x.size(), reach = std::min(lags, N - 1);
    std::size_t length = 1;
    while (length < static_cast<std::size_t>(N + reach)) length *= 2;
    Eigen::FFT<double> transform;
    std::vector<std::complex<double>> X, Y;
    transform.fwd(X, padded(x, length));
    transform.fwd(Y, padded(y, length));
    for (std::size_t i = 0; i < length; ++i) X[i] *= std::conj(Y[i]);
    std::vector<double> circular;
    transform.inv(circular, X);
    Vector sums = Vector::Zero(2 * lags + 1);
    for (Index lag = -reach; lag <= reach; ++lag)
        sums[lags + lag] = circular[lag >= 0 ? static_cast<std::size_t>(lag) : length - static_cast<std::size_t>(-lag)];
    return sums;
}

}  // namespace

Vector lagged_products(const VectorView& x, const VectorView& y, Index lags) {
    if (x.size() != y.size() || x.size() == 0)
        throw InvalidArgument("A correlation needs two signals of equal length, and these have " +
                              std::to_string(x.size()) + " and " + std::to_string(y.size()) + " samples");
    if (lags < 0) throw InvalidArgument("The number of lags must not be negative, and is " + std::to_string(lags));
    return lags <= kDirectLags ? direct_products(x, y, lags) : transformed_products(x, y, lags);
}

}  // namespace dynlab::inline numerics
