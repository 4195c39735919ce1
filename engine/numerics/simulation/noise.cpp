#include "numerics/simulation/noise.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kRunInDecay = 1e-8;
constexpr double kMaxRunIn = 1e6;  // samples

/// Samples after which the response of C/D has decayed; 0 where it has none, or where it never does.
Index decay_time(const Vector& C, const Vector& D) {
    if (D.size() == 1) return C.size() - 1;
    const double slowest = roots(D).cwiseAbs().maxCoeff();
    if (slowest >= 1) return 0;
    const double samples = slowest == 0 ? 0 : std::log(kRunInDecay) / std::log(slowest);
    // Roots that lie together decay more slowly than one of them.
    return static_cast<Index>(std::min(static_cast<double>(D.size()) * samples, kMaxRunIn)) + C.size() + D.size();
}

Vector colored(const Vector& C, const Vector& D, const Vector& e) {
    Vector v = Vector::Zero(e.size());
    for (Index i = 0; i < std::min(C.size(), e.size()); ++i) v.tail(e.size() - i) += C[i] * e.head(e.size() - i);
    for (Index k = 1; k < v.size(); ++k)
        for (Index i = 1; i < std::min(D.size(), k + 1); ++i) v[k] -= D[i] * v[k - i];
    return v;
}

}  // namespace

double ColoredNoise::gain() const {
    if (D.size() > 1 && roots(D).cwiseAbs().maxCoeff() >= 1)
        throw InvalidArgument(
            "The noise model has a pole on or outside the unit circle, so its noise has no finite standard deviation");
    const Index length = decay_time(C, D) + 1;
    return colored(C, D, Vector::Unit(length, 0)).norm();
}

Vector ColoredNoise::draw(Index count, double sigma, RandomStream& random) const {
    if (!(sigma >= 0) || !std::isfinite(sigma))
        throw InvalidArgument("The standard deviation of the noise must be nonnegative, but {} was given", sigma);
    return colored(C, D, sigma * random.normal(decay_time(C, D) + count)).tail(count);
}

double noise_std_of_snr(const VectorView& x, double snr) {
    if (!std::isfinite(snr)) throw InvalidArgument("snr must be a finite number in dB, but {} was given", snr);
    const double scale = std::sqrt((x.array() - x.mean()).square().sum() / static_cast<double>(x.size()));
    if (!std::isfinite(scale))
        throw InvalidArgument("snr needs a noise-free output that is finite; use a stable model");
    if (scale == 0)
        throw InvalidArgument("snr needs a noise-free output that changes; use an input that excites the system");
    return scale * std::pow(10.0, -snr / 20);
}

}  // namespace dynlab::inline numerics
