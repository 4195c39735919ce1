#include "figures/plots/levels_plot.h"

#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

void add_levels(Panel& panel, const Message& label, const Vector& w, const Vector& power, CurveStyle style, int look) {
    if (power.size() == 0 || !(power.array() > 0).any()) return;
    Curve curve;
    curve.x = w;
    curve.y = (power.array() > 0).select(10 * power.array().max(1e-300).log10(), kNaN);
    curve.label = label;
    curve.style = style;
    curve.color = look, curve.marker = look, curve.dash = 0;
    panel.curves.push_back(std::move(curve));
}

}  // namespace

Figure levels_plot(const FrequencyData& data) {
    if (data.excited.w.size() == 0) throw InvalidArgument("no output levels to draw");
    Panel panel;
    panel.log_x = true;
    panel.x_label = axis_label(Message("frequency"), "rad/s");
    panel.y_label = axis_label(Message("level"), "dB");
    add_levels(panel, Message("output"), data.excited.w, data.excited.power, CurveStyle::kLinePoints, 0);
    add_levels(panel, Message("noise"), data.excited.w, data.excited.noise, CurveStyle::kLine, 1);
    add_levels(panel, Message("distortion"), data.excited.w, data.excited.distortion, CurveStyle::kPoints, 2);
    add_levels(panel, Message("odd lines without input"), data.odd.w, data.odd.power, CurveStyle::kPoints, 3);
    add_levels(panel, Message("even lines without input"), data.even.w, data.even.power, CurveStyle::kPoints, 4);
    if (panel.curves.empty()) throw InvalidArgument("nothing to draw: the output is zero at all lines");
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
