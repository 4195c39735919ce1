#include "figures/plots/time_response_panel.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

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

Vector instants(const TransferFunction& G, const Vector& wanted, double end) {
    if (wanted.size() > 0) return wanted;
    if (G.continuous()) return Vector::LinSpaced(kCurvePoints, 0, end);
    const Index count = static_cast<Index>(std::floor(end / G.Ts() + 1e-9)) + 1;
    return Vector::LinSpaced(count, 0, static_cast<double>(count - 1) * G.Ts());
}

}  // namespace

Figure time_response_figure(const std::vector<NamedModel>& models, const Vector& t, CurveStyle discrete_style,
                            const std::function<TimeResponse(const TransferFunction&, const VectorView&)>& response) {
    if (models.empty()) throw InvalidArgument("there are no models to plot");
    const double end = t.size() > 0 ? 0 : longest_window(models);
    Panel panel;
    panel.x_label = "time (s)";
    panel.y_label = "amplitude";
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

}  // namespace dynlab::inline figures
