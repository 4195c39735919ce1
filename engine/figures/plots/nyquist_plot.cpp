#include "figures/plots/nyquist_plot.h"

#include <algorithm>
#include <cmath>

#include "figures/plots/bode_plot.h"
#include "numerics/error.h"
#include "numerics/simulation/frequency_response.h"

namespace dynlab::inline figures {
namespace {

constexpr Index kNyquistPoints = 2000;
constexpr double kFarFactor = 8;

/// Points much farther out than half of all points, and than the critical point, become gaps.
void leave_out_far_points(ComplexVector& response) {
    Vector size = response.cwiseAbs();
    std::nth_element(size.begin(), size.begin() + size.size() / 2, size.end());
    const double limit = kFarFactor * std::max(1.0, size[size.size() / 2]);
    for (Complex& value : response)
        if (!(std::abs(value) <= limit)) value = Complex(std::nan(""), std::nan(""));
}

void add_direction(Panel& panel, const ComplexVector& response) {
    double extent = 0;
    Index start = 0;  // where the curve lies farthest from the real axis
    for (Index i = 0; i < response.size(); ++i) {
        if (!std::isfinite(response[i].real())) continue;
        extent = std::max(extent, std::abs(response[i]));
        const bool first = !std::isfinite(response[start].real());
        if (first || std::abs(response[i].imag()) > std::abs(response[start].imag())) start = i;
    }
    for (Index end = start + 1; end < response.size(); ++end)
        if (std::abs(response[end] - response[start]) > 0.04 * extent) {
            panel.arrows.push_back({response[start].real(),
                                    response[start].imag(),
                                    response[end].real(),
                                    response[end].imag(),
                                    {},
                                    false});
            return;
        }
}

}  // namespace

Figure nyquist_plot(const std::vector<NamedModel>& models, const Vector& w) {
    if (models.empty()) throw InvalidArgument("no models to plot");
    const Vector grid = w.size() > 0 ? w : joint_frequency_grid(models, kNyquistPoints);
    Panel panel;
    panel.x_label = Message("real part");
    panel.y_label = Message("imaginary part");
    panel.equal_axes = true;
    int index = 0;
    for (const NamedModel& model : models) {
        ComplexVector response = frequency_response(model.G, grid);
        leave_out_far_points(response);
        Curve curve;
        curve.x = response.real();
        curve.y = response.imag();
        curve.label = model.name;
        curve.color = index++;
        panel.curves.push_back(curve);
        curve.y = -curve.y;
        curve.label = {};
        curve.line_width *= 0.5;
        panel.curves.push_back(std::move(curve));
        add_direction(panel, response);
    }
    panel.references = {{true, 0, {}, 2}, {false, 0, {}, 2}};
    panel.annotations = {{-1, 0, Message::verbatim("−1"), true}};
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
