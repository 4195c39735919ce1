#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

namespace {

/// The point of the s plane that corresponds to a pole or zero.
Complex continuous_point(const TransferFunction& G, Complex point) {
    return G.continuous() ? point : std::log(point) / G.Ts();
}

PoleDescription describe(const TransferFunction& G, Complex pole) {
    if (!G.continuous() && pole == Complex(0)) return {pole, kInfinity, 1, 0};  // gone after one sample
    const Complex s = continuous_point(G, pole);
    const double frequency = std::abs(s);
    const double damping_ratio = frequency > 0 ? -s.real() / frequency : std::numeric_limits<double>::quiet_NaN();
    return {pole, frequency, damping_ratio, s.real() == 0 ? kInfinity : -1 / s.real()};
}

double magnitude(const TransferFunction& G, double w) {
    return std::abs(G.at(G.continuous() ? Complex(0, w) : std::polar(1.0, w * G.Ts())));
}

/// Frequencies close enough to each other that a crossing is not stepped over, the corners themselves among them.
std::vector<double> search_grid(const TransferFunction& G, const Vector& corners) {
    constexpr double kDecadesBeyond = 4;
    constexpr int kPointsPerDecade = 100;
    const double first = std::log10(corners(0)) - kDecadesBeyond;
    double last = std::log10(corners(corners.size() - 1)) + kDecadesBeyond;
    if (!G.continuous()) last = std::min(last, std::log10(std::numbers::pi / G.Ts()));
    std::vector<double> grid(corners.begin(), corners.end());
    const int count = std::max(2, static_cast<int>((last - first) * kPointsPerDecade));
    for (int i = 0; i < count; ++i) grid.push_back(std::pow(10, first + (last - first) * i / (count - 1)));
    std::ranges::sort(grid);
    grid.erase(std::ranges::upper_bound(grid, std::pow(10, last)), grid.end());
    return grid;
}

/// Between `low`, where |G| is above the level, and `high`, where it is below.
double crossing(const TransferFunction& G, double low, double high, double level) {
    constexpr double kRelativeWidth = 1e-13;
    while (high - low > kRelativeWidth * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (magnitude(G, middle) < level ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

std::vector<PoleDescription> damping(const TransferFunction& G) {
    std::vector<PoleDescription> rows;
    for (const Complex& pole : G.poles()) rows.push_back(describe(G, pole));
    std::ranges::stable_sort(rows, {}, &PoleDescription::natural_frequency);
    return rows;
}

Vector corner_frequencies(const TransferFunction& G) {
    std::vector<double> corners;
    const auto collect = [&](const ComplexVector& points) {
        for (const Complex& point : points) {
            const double frequency = std::abs(continuous_point(G, point));
            if (frequency > 0 && std::isfinite(frequency)) corners.push_back(frequency);
        }
    };
    collect(G.poles());
    collect(G.zeros());
    std::ranges::sort(corners);
    return Eigen::Map<const Vector>(corners.data(), static_cast<Index>(corners.size()));
}

double bandwidth(const TransferFunction& G) {
    const double gain = std::abs(G.dc_gain());
    if (!(gain > 0) || !std::isfinite(gain)) return std::numeric_limits<double>::quiet_NaN();
    const Vector corners = corner_frequencies(G);
    if (corners.size() == 0) return kInfinity;
    const double level = gain * std::pow(10, -3.0 / 20);
    double above = 0;
    for (const double w : search_grid(G, corners)) {
        if (magnitude(G, w) < level) return crossing(G, above, w, level);
        above = w;
    }
    return kInfinity;
}

}  // namespace dynlab::inline numerics
