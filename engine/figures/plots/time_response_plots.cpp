#include "figures/plots/time_response_plots.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "figures/confidence_band.h"
#include "numerics/error.h"
#include "numerics/simulation/time_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {
namespace {

constexpr Index kCurvePoints = 600;

double longest_window(const std::vector<NamedModel>& models) {
    double end = 0;
    for (const NamedModel& model : models) {
        const Vector grid = natural_time_grid(model.G);
        end = std::max(end, grid[grid.size() - 1]);
    }
    return end;
}

Vector instants(const TransferFunction& G, const Vector& requested, double end) {
    if (requested.size() > 0) return requested;
    if (G.continuous()) return Vector::LinSpaced(kCurvePoints, 0, end);
    const Index count = samples_within(end, G.Ts());
    return Vector::LinSpaced(count, 0, static_cast<double>(count - 1) * G.Ts());
}

/// What step_plot and impulse_plot share: one curve per model over one window. `discrete_style` draws the samples of
/// discrete models.
Figure time_response_figure(const std::vector<NamedModel>& models, const Vector& t, CurveStyle discrete_style,
                            const std::function<TimeResponse(const TransferFunction&, const VectorView&)>& response) {
    if (models.empty()) throw InvalidArgument("no models to plot");
    const double end = t.size() > 0 ? 0 : longest_window(models);
    Panel panel;
    panel.x_label = axis_label(Message("time"), "s");
    panel.y_label = Message("amplitude");
    for (const NamedModel& model : models) {
        const TimeResponse result = response(model.G, instants(model.G, t, end));
        Curve curve;
        curve.x = result.t;
        curve.y = result.y;
        curve.label = model.name;
        if (!model.G.continuous()) curve.style = discrete_style;
        panel.curves.push_back(std::move(curve));
    }
    return Figure(std::move(panel));
}

}  // namespace

Index samples_within(double end, double Ts) {
    constexpr double kMax = 1e7;
    const double count = std::floor(end / Ts + 1e-9) + 1;
    if (!(count <= kMax))
        throw InvalidArgument(
            "a window of {} s of a model with Ts = {} s has too many samples for one figure: {}. Use a shorter window",
            end, Ts, significant(count, 3));
    return static_cast<Index>(count);
}

Figure step_plot(const std::vector<NamedModel>& models, const Vector& t) {
    Figure figure = time_response_figure(models, t, CurveStyle::kStairs, step_response);
    Panel& panel = figure.panels.front();
    fix_colors(panel);
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (!models[i].confidence) continue;
        const auto& [model, level] = *models[i].confidence;
        const Vector width = normal_half_width(level) * step_response_std(model, panel.curves[i].x);
        const Vector& y = panel.curves[i].y;
        add_confidence_band(panel, i, width, level, y.maxCoeff() - y.minCoeff());
    }
    limit_to_readable(panel, models.size(), 0);
    return figure;
}

Figure impulse_plot(const std::vector<NamedModel>& models, const Vector& t) {
    return time_response_figure(models, t, CurveStyle::kStems, impulse_response);
}

}  // namespace dynlab::inline figures
