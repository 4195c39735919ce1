#include "figures/plots/impulse_estimate_plot.h"

#include "figures/plots/time_response_plots.h"
#include "figures/style.h"
#include "numerics/error.h"
#include "numerics/simulation/time_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {
namespace {

constexpr Index kModelPoints = 500;

Curve stems_of(const ImpulseEstimate& estimate, double Ts) {
    Curve stems;
    stems.x = estimate.t;
    stems.y = estimate.response / Ts;
    stems.style = CurveStyle::kStems;
    stems.color = 0;
    stems.dash = 0;
    stems.marker = 0;
    stems.label = Message("estimate");
    return stems;
}

Curve band_of(const ImpulseEstimate& estimate, double Ts, double level) {
    Curve band;
    band.x = estimate.t;
    band.y_upper = normal_half_width(level) * estimate.null_std / Ts;
    band.y = -band.y_upper;
    band.style = CurveStyle::kBand;
    band.color = style::kGrayColor;
    band.label = Message("{} % confidence bounds", significant(100 * level, 4));
    return band;
}

/// A discrete model's response to a unit sample is divided by its sampling time like the estimate.
Curve curve_of(const NamedModel& model, double end, int color) {
    Vector t = Vector::LinSpaced(kModelPoints, 0, end);
    if (!model.G.continuous()) {
        const Index count = samples_within(end, model.G.Ts());
        t = Vector::LinSpaced(count, 0, static_cast<double>(count - 1) * model.G.Ts());
    }
    const TimeResponse response = impulse_response(model.G, t);
    Curve curve;
    curve.x = response.t;
    curve.y = response.y;
    curve.label = model.name;
    curve.color = color;
    return curve;
}

}  // namespace

Figure impulse_estimate_plot(const ImpulseEstimate& estimate, double Ts, const std::vector<NamedModel>& models,
                             double level) {
    if (estimate.t.size() == 0) throw InvalidArgument("no impulse response to draw");
    Panel panel;
    panel.x_label = axis_label(Message("time"), "s");
    panel.y_label = Message("impulse response (per s)");
    panel.curves = {band_of(estimate, Ts, level), stems_of(estimate, Ts)};
    const double end = estimate.t[estimate.t.size() - 1];
    int color = 1;
    for (const NamedModel& model : models) panel.curves.push_back(curve_of(model, end, color++));
    panel.references = {{true, 0, {}, 0}};
    panel.x_range = {-0.02 * end, 1.02 * end};
    if (estimate.first && *estimate.first > 1) {
        const double dead_time = static_cast<double>(*estimate.first - 1) * Ts;
        panel.references.push_back({false, dead_time, Message("dead time {} s", significant(dead_time, 4)), 1});
    }
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
