#include "figures/plots/pole_zero_map.h"

#include <cmath>
#include <numbers>

#include "figures/axis.h"
#include "figures/confidence_band.h"
#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

constexpr double kDampingRatios[] = {0.2, 0.4, 0.6, 0.8};

Curve guide(Vector x, Vector y) {
    Curve curve;
    curve.x = std::move(x);
    curve.y = std::move(y);
    curve.color = style::kGrayColor;
    curve.dash = 2;
    curve.line_width = 0.5;
    return curve;
}

void add_guide_pair(Panel& panel, const Vector& x, const Vector& y) {
    panel.curves.push_back(guide(x, y));
    panel.curves.push_back(guide(x, -y));
}

void add_unit_circle_and_spirals(Panel& panel) {
    const Vector angle = Vector::LinSpaced(361, 0, 2 * std::numbers::pi);
    panel.curves.push_back(guide(angle.array().cos(), angle.array().sin()));
    panel.curves.back().dash = 0;
    const Vector phase = Vector::LinSpaced(181, 0, std::numbers::pi);
    for (const double damping : kDampingRatios) {
        const Vector radius = (-damping / std::sqrt(1 - damping * damping) * phase.array()).exp();
        add_guide_pair(panel, radius.array() * phase.array().cos(), radius.array() * phase.array().sin());
    }
}

void add_damping_rays(Panel& panel, double reach) {
    for (const double damping : kDampingRatios) {
        const double x = -reach * damping, y = reach * std::sqrt(1 - damping * damping);
        add_guide_pair(panel, Vector{{0, x}}, Vector{{0, y}});
    }
}

void add_roots(Panel& panel, const ComplexVector& roots, const Message& label, int color, int marker) {
    if (roots.size() == 0) return;
    Curve curve;
    curve.x = roots.real();
    curve.y = roots.imag();
    curve.label = label;
    curve.style = CurveStyle::kPoints;
    curve.color = color;
    curve.marker = marker;
    curve.line_width = 1.6;
    panel.curves.push_back(std::move(curve));
}

void add_regions(Panel& panel, const ModelConfidence& confidence, int color, const Message& label, Extent& real,
                 Extent& imaginary) {
    std::vector<RootUncertainty> roots = pole_uncertainty(confidence.model);
    for (const RootUncertainty& zero : zero_uncertainty(confidence.model)) roots.push_back(zero);
    constexpr double kReach = 3;  // times the farthest root: no huge region hides the others
    double reach = 0;
    for (const RootUncertainty& root : roots) reach = std::max(reach, kReach * std::abs(root.root));
    bool first = true;
    for (const RootUncertainty& root : roots) {
        if (!root.covariance.allFinite()) continue;
        const Matrix region = confidence_region(root, confidence.level);
        Curve curve;
        curve.x = region.col(0);
        curve.y = region.col(1);
        curve.color = color;
        curve.line_width = root.root.imag() == 0 ? 1.6 : 0.7;
        if (first) curve.label = label;
        first = false;
        real.include(Vector(curve.x.cwiseMax(-reach).cwiseMin(reach)));
        imaginary.include(Vector(curve.y.cwiseMax(-reach).cwiseMin(reach)));
        panel.curves.push_back(std::move(curve));
    }
}

}  // namespace

Figure pole_zero_map(const std::vector<NamedModel>& models) {
    if (models.empty()) throw InvalidArgument("no models to plot");
    const bool continuous = models.front().G.continuous();
    Extent real(false), imaginary(false);
    real.include(0), imaginary.include(0);
    if (!continuous)
        for (const double edge : {-1.0, 1.0}) real.include(edge), imaginary.include(edge);
    Panel panel;
    int color = 0;
    bool explained = false;
    for (const NamedModel& model : models) {
        if (model.G.continuous() != continuous)
            throw InvalidArgument("continuous-time and discrete-time models cannot share a pole-zero map");
        const ComplexVector poles = model.G.poles(), zeros = model.G.zeros();
        for (const ComplexVector* roots : {&poles, &zeros})
            real.include(Vector(roots->real())), imaginary.include(Vector(roots->imag()));
        const int mark = color % style::kPoleMarkers;
        add_roots(panel, poles, model.name.empty() ? Message("poles") : Message("{}: poles", model.name), color,
                  style::kCross + mark);
        add_roots(panel, zeros, model.name.empty() ? Message("zeros") : Message("{}: zeros", model.name), color,
                  style::kOpenCircle + mark);
        if (model.confidence) {
            const double level = model.confidence->level;
            add_regions(panel, *model.confidence, color, explained ? Message() : confidence_text(level), real,
                        imaginary);
            explained = true;
        }
        ++color;
    }
    if (panel.curves.empty()) throw InvalidArgument("nothing to draw: the models have neither poles nor zeros");
    panel.equal_axes = true;
    panel.x_range = real.padded(0.12);
    panel.y_range = imaginary.padded(0.12);
    const auto [left, right] = *panel.x_range;
    const auto [bottom, top] = *panel.y_range;
    if (continuous)
        add_damping_rays(panel, 10 * std::max({-left, right, -bottom, top}));
    else
        add_unit_circle_and_spirals(panel);
    panel.references = {{true, 0, {}, 0}, {false, 0, {}, 0}};
    panel.x_label = axis_label(Message("real axis"), continuous ? "1/s" : "");
    panel.y_label = axis_label(Message("imaginary axis"), continuous ? "rad/s" : "");
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
