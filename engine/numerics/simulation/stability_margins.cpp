#include "numerics/simulation/stability_margins.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNever = std::numeric_limits<double>::infinity();

Complex response_at(const TransferFunction& G, double w) {
    return G.at(G.continuous() ? Complex(0, w) : std::polar(1.0, w * G.Ts()));
}

/// Where `value` changes its sign between low and high, to rounding.
double sign_change(const std::function<double(double)>& value, double low, double high) {
    const bool rising = value(high) > 0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        ((value(middle) > 0) == rising ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// Frequencies around every pole and zero, s-plane roots of discrete models by log(z)/Ts, as close as their damping.
void add_resonances(std::vector<double>& grid, const TransferFunction& G) {
    for (const ComplexVector& all : {G.poles(), G.zeros()})
        for (const Complex& root : all) {
            if (!G.continuous() && std::abs(root) == 0) continue;
            const Complex s = G.continuous() ? root : std::log(root) / G.Ts();
            const double width = std::max(std::abs(s.real()), 1e-9 * std::abs(s));
            for (int i = -40; i <= 40; ++i) grid.push_back(std::abs(s.imag()) + width * i / 8.0);
        }
}

/// Rising frequencies from far below the corner frequencies up to `last`, neighbors within a small part of a turn of
/// the delay.
std::vector<double> margin_grid(const TransferFunction& G, double first, double last) {
    constexpr int kPerDecade = 400;
    std::vector<double> grid;
    const double decades = std::log10(last / first);
    const auto count = static_cast<int>(std::ceil(kPerDecade * decades));
    for (int i = 0; i <= count; ++i) grid.push_back(first * std::pow(10.0, decades * i / count));
    add_resonances(grid, G);
    const double turn = G.continuous() ? G.delay() : G.delay() + G.Ts() * static_cast<double>(G.pole_count());
    if (turn > 0) {
        constexpr double kPart = 0.05, kMax = 2e5;  // rad; steps at most
        const double step = std::max(kPart / turn, last / kMax);
        for (double w = step; w < last; w += step) grid.push_back(w);
    }
    std::sort(grid.begin(), grid.end());
    const auto outside = [&](double w) { return !(w >= first && w <= last); };
    grid.erase(std::remove_if(grid.begin(), grid.end(), outside), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    return grid;
}

StabilityMargins::Crossover phase_crossover(const TransferFunction& G, double w) {
    double angle = 180 + std::arg(response_at(G, w)) * 180 / kPi;
    if (angle > 180) angle -= 360;
    return {w, angle};
}

std::vector<StabilityMargins::Crossover> unit_crossovers(const TransferFunction& G, const std::vector<double>& grid) {
    const auto excess = [&](double w) { return std::norm(response_at(G, w)) - 1; };
    std::vector<StabilityMargins::Crossover> found;
    for (std::size_t i = 1; i < grid.size(); ++i)
        if ((excess(grid[i - 1]) > 0) != (excess(grid[i]) > 0))
            found.push_back(phase_crossover(G, sign_change(excess, grid[i - 1], grid[i])));
    return found;
}

std::vector<StabilityMargins::Crossover> axis_crossovers(const TransferFunction& G, const std::vector<double>& grid) {
    const auto imaginary = [&](double w) { return response_at(G, w).imag(); };
    std::vector<StabilityMargins::Crossover> found;
    const auto add = [&](double w, double real) {
        if (real < 0 && std::isfinite(real)) found.push_back({w, -1 / real});
    };
    const double dc = G.dc_gain();
    add(0, dc);
    double w_before = 0;
    Complex before = 0;
    for (const double w : grid) {
        const Complex here = response_at(G, w);
        if (here.imag() == 0) continue;  // a crossing, if its neighbors say so
        if ((before.imag() > 0) != (here.imag() > 0) && before.real() < 0 && here.real() < 0) {
            const double crossing = sign_change(imaginary, w_before, w);
            add(crossing, response_at(G, crossing).real());
        }
        w_before = w;
        before = here;
    }
    if (!G.continuous()) add(kPi / G.Ts(), G.at(-1.0).real());
    return found;
}

/// The part of the axis to search for crossovers of the unit circle: far beyond the corner frequencies and the delay,
/// and up to the crossover of an integrator or a large gain.
struct Range {
    double first, last;
};
Range searched_range(const TransferFunction& G) {
    constexpr double kFar = 1e4;
    constexpr int kMaxDecades = 60;
    const Vector corners = corner_frequencies(G);
    double lowest = kNever, highest = 0;
    for (const double w : corners) {
        lowest = std::min(lowest, w);
        highest = std::max(highest, w);
    }
    if (G.delay() > 0 || corners.size() == 0) {
        const double w = G.delay() > 0 ? 1 / G.delay() : 1;
        lowest = std::min(lowest, w);
        highest = std::max(highest, w);
    }
    Range range{lowest / kFar, highest * kFar};
    if (!G.continuous()) range = {std::min(range.first, kPi / G.Ts() / kFar), kPi / G.Ts()};
    const auto magnitude = [&](double w) { return std::abs(response_at(G, w)); };
    const bool integrates = evaluate(G.den(), G.continuous() ? 0.0 : 1.0) == 0;
    for (int i = 0; i < kMaxDecades && integrates && magnitude(range.first) < 1; ++i) range.first /= 10;
    const bool falls = G.continuous() && G.zero_count() < G.pole_count();
    for (int i = 0; i < kMaxDecades && falls && magnitude(range.last) > 1; ++i) range.last *= 10;
    return range;
}

}  // namespace

StabilityMargins stability_margins(const TransferFunction& G) {
    constexpr double kTurns = 20;
    if (G.num().isZero(0)) return {{}, {}, kNever, kNaN, kNever, kNaN, kNever};
    StabilityMargins margins{};
    const auto [first, last] = searched_range(G);
    // |L| knows no delay, so that a logarithmic axis shows all its crossovers.
    margins.phases = unit_crossovers(G, margin_grid(G.with_delay(0), first, last));
    double end = last;
    if (G.continuous() && G.delay() > 0) {
        const Vector corners = corner_frequencies(G);
        end = 2 * kPi * kTurns / G.delay() + (corners.size() > 0 ? 10 * corners.maxCoeff() : 0);
        if (!margins.phases.empty()) end += margins.phases.back().frequency;
    }
    margins.gains = axis_crossovers(G, margin_grid(G, std::min(first, end), end));
    margins.gain_margin = margins.phase_margin = margins.delay_margin = kNever;
    margins.gain_frequency = margins.phase_frequency = kNaN;
    for (const auto& [w, factor] : margins.gains)
        if (std::abs(std::log(factor)) < std::abs(std::log(margins.gain_margin))) {
            margins.gain_margin = factor;
            margins.gain_frequency = w;
        }
    for (const auto& [w, angle] : margins.phases) {
        if (std::abs(angle) < std::abs(margins.phase_margin)) {
            margins.phase_margin = angle;
            margins.phase_frequency = w;
        }
        margins.delay_margin = std::min(margins.delay_margin, (angle < 0 ? angle + 360 : angle) * kPi / 180 / w);
    }
    return margins;
}

}  // namespace dynlab::inline numerics
