#include "numerics/signals/fourier.h"

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace dynlab::inline numerics {

namespace {

using Samples = std::vector<Complex>;

constexpr Index kLargestPrime = 50;

Index largest_prime_factor(Index n) {
    Index largest = 1;
    for (Index p = 2; p * p <= n; ++p)
        for (; n % p == 0; n /= p) largest = p;
    return std::max(largest, n);
}

/// k n = (k^2 + n^2 - (k - n)^2)/2 turns the transform into a convolution with the chirp exp(i pi n^2/N).
Samples by_convolution(const Samples& x) {
    const Index N = static_cast<Index>(x.size());
    std::size_t length = 1;
    while (length < static_cast<std::size_t>(2 * N)) length *= 2;
    Samples chirp(static_cast<std::size_t>(N)), signal(length), kernel(length), S, K, product;
    for (Index n = 0; n < N; ++n) {
        const auto turned = static_cast<double>((n * n) % (2 * N));
        const auto i = static_cast<std::size_t>(n);
        chirp[i] = std::polar(1.0, std::numbers::pi * turned / static_cast<double>(N));
        signal[i] = x[i] * std::conj(chirp[i]);
        kernel[i] = chirp[i];
        if (n > 0) kernel[length - i] = chirp[i];
    }
    Eigen::FFT<double> transform;
    transform.fwd(S, signal);
    transform.fwd(K, kernel);
    for (std::size_t i = 0; i < length; ++i) S[i] *= K[i];
    transform.inv(product, S);
    Samples result(static_cast<std::size_t>(N));
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = product[k] * std::conj(chirp[k]);
    return result;
}

ComplexVector transform_of(const Samples& x) {
    Samples X;
    if (largest_prime_factor(static_cast<Index>(x.size())) > kLargestPrime) {
        X = by_convolution(x);
    } else {
        Eigen::FFT<double> transform;
        transform.fwd(X, x);
    }
    return Eigen::Map<const ComplexVector>(X.data(), static_cast<Index>(X.size()));
}

/// A power of two that brings y near the size of x: the rounding errors of the larger one would drown the other.
double scale_between(const VectorView& x, const VectorView& y) {
    const double largest = x.cwiseAbs().maxCoeff(), other = y.cwiseAbs().maxCoeff();
    if (!(largest > 0) || !(other > 0)) return 1;
    return std::exp2(std::round(std::log2(largest / other)));
}

}  // namespace

ComplexVector fourier_transform(const VectorView& x) {
    if (x.size() <= 1) return x.cast<Complex>();
    return transform_of(Samples(x.begin(), x.end()));
}

TransformPair fourier_transforms(const VectorView& x, const VectorView& y) {
    const Index N = x.size();
    if (N <= 1) return {x.cast<Complex>(), y.cast<Complex>()};
    const double scale = scale_between(x, y);
    Samples both(static_cast<std::size_t>(N));
    for (Index n = 0; n < N; ++n) both[static_cast<std::size_t>(n)] = {x[n], scale * y[n]};
    const ComplexVector Z = transform_of(both);
    TransformPair pair{ComplexVector(N), ComplexVector(N)};
    for (Index k = 0; k < N; ++k) {
        const Complex here = Z[k], opposite = std::conj(Z[k == 0 ? 0 : N - k]);
        pair.first[k] = 0.5 * (here + opposite);
        pair.second[k] = Complex(0, -0.5 / scale) * (here - opposite);
    }
    return pair;
}

}  // namespace dynlab::inline numerics
