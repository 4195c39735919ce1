#include "numerics/signals/box_muller.h"

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace dynlab::inline numerics {

namespace {

/// ln x for normal x in (0, 1]: x = m 2^e with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh((m - 1)/(m + 1)).
inline double logarithm(double x) {
    constexpr std::uint64_t kOne = std::bit_cast<std::uint64_t>(1.0);
    constexpr std::uint64_t kToMiddle = kOne - std::bit_cast<std::uint64_t>(std::numbers::sqrt2 / 2);
    constexpr std::uint64_t kBias = 1023;
    constexpr double kWhole = 0x1p52;  // the last bits of whole numbers from here on are the number itself
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x), biased = (bits + kToMiddle) >> 52;
    const double exponent = std::bit_cast<double>(std::bit_cast<std::uint64_t>(kWhole) | biased) - kWhole - kBias;
    const double m = std::bit_cast<double>(bits - ((biased - kBias) << 52));
    const double s = (m - 1) / (m + 1), z = s * s;
    double series = 1. / 23;  // |s| < 0.172: what is left out is below 1e-19
    for (int k = 21; k > 1; k -= 2) series = 1. / k + z * series;
    return exponent * std::numbers::ln2 + 2 * (s + s * z * series);
}

/// 1 - z/(f (f+1)) (1 - z/((f+2) (f+3)) (1 - ...)); for z <= (pi/4)^2 what is left out is below 1e-18.
inline double series(double z, int f) {
    double sum = 1;
    for (int k = 14; k >= 0; k -= 2) sum = 1 - z * (1. / ((f + k) * (f + k + 1))) * sum;
    return sum;
}

struct SineCosine {
    double sine, cosine;
};

/// Of 2 pi u, u in [0, 1), by the nearest quarter of a turn, -2 to 2 from the half turn, and what is left.
inline SineCosine of_turn(double u) {
    constexpr double kRound = 0x1.8p52;  // sums with it have no room for a fraction
    const double quarters = 4 * u - 2, quarter = (quarters + kRound) - kRound;
    const double x = std::numbers::pi / 2 * (quarters - quarter), z = x * x;
    const double sine = x * series(z, 2), cosine = series(z, 1);
    // Cosine and sine of the quarter and the half turn: whole numbers, one of them 0.
    const double along = std::abs(quarter) - 1, across = -quarter * (2 - std::abs(quarter));
    return {along * sine + across * cosine, along * cosine - across * sine};
}

}  // namespace

void box_muller(const NormalPairs& u1, const NormalPairs& u2, NormalPairs& cosines, NormalPairs& sines) {
    using Pairs = Eigen::Array<double, kNormalPairs, 1>;
    NormalPairs squares;
    for (int i = 0; i < kNormalPairs; ++i) squares[i] = -2 * logarithm(1 - u1[i]);
    const Pairs radius = Eigen::Map<const Pairs>(squares.data()).sqrt();
    for (int i = 0; i < kNormalPairs; ++i) {
        const SineCosine direction = of_turn(u2[i]);
        cosines[i] = radius[i] * direction.cosine;
        sines[i] = radius[i] * direction.sine;
    }
}

}  // namespace dynlab::inline numerics
