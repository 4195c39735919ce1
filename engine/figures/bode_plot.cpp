#include "figures/bode_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/error.h"
#include "numerics/simulation/frequency_response.h"

namespace dynlab {
namespace {

constexpr Index kCurvePoints = 800;

Vector below_nyquist(const TransferFunction& G, const Vector& w) {
    if (G.continuous()) return w;
    const double end = std::numbers::pi / G.Ts() * (1 + 1e-9);
    std::vector<double> kept;
    std::copy_if(w.begin(), w.end(), std::back_inserter(kept), [end](double value) { return value <= end; });
    if (kept.empty())
        throw InvalidArgument(
            fmt::format("all frequencies lie above pi/Ts = {:.4g} rad/s, where a discrete model ends", end));
    return Eigen::Map<const Vector>(kept.data(), static_cast<Index>(kept.size()));
}

double phase_step(const Panel& phase) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Curve& curve : phase.curves)
        for (const double value : curve.y)
            if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    return high - low <= 200 ? 45 : high - low <= 450 ? 90 : 180 * std::ceil((high - low) / 900);
}

}  // namespace

Vector joint_frequency_grid(const std::vector<NamedModel>& models, Index count) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const NamedModel& model : models) {
        const Vector grid = natural_frequency_grid(model.G);
        low = std::min(low, grid[0]);
        high = std::max(high, grid[grid.size() - 1]);
    }
    return Vector::LinSpaced(count, std::log(low), std::log(high)).array().exp();
}

Figure bode_plot(const std::vector<NamedModel>& models, const Vector& w) {
    if (models.empty()) throw InvalidArgument("there are no models to plot");
    if (w.size() > 0 && !(w.minCoeff() > 0))
        throw InvalidArgument(fmt::format("frequencies must be positive, but the smallest is {}", w.minCoeff()));
    const Vector grid = w.size() > 0 ? w : joint_frequency_grid(models, kCurvePoints);
    Panel magnitude, phase;
    magnitude.log_x = phase.log_x = true;
    magnitude.y_label = "magnitude (dB)";
    phase.y_label = "phase (°)";
    phase.x_label = "frequency (rad/s)";
    phase.legend = LegendPlace::kNone;
    for (const NamedModel& model : models) {
        Curve curve;
        curve.x = below_nyquist(model.G, grid);
        const ComplexVector response = frequency_response(model.G, curve.x);
        curve.label = model.name;
        curve.y = magnitude_db(response);
        magnitude.curves.push_back(curve);
        curve.y = phase_degrees_unwrapped(response);
        phase.curves.push_back(std::move(curve));
        if (model.G.continuous()) continue;
        const ReferenceLine end{false, std::numbers::pi / model.G.Ts(), "", 2};
        if (end.at <= grid.maxCoeff() * 1.001) magnitude.references.push_back(end), phase.references.push_back(end);
    }
    phase.y_tick_step = phase_step(phase);
    const std::pair<double, double> range{grid.minCoeff(), grid.maxCoeff()};
    if (range.first < range.second) magnitude.x_range = phase.x_range = range;
    Figure figure;
    figure.rows = 2;
    figure.panels = {std::move(magnitude), std::move(phase)};
    return figure;
}

}  // namespace dynlab
