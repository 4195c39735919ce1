#include "figures/plots/delay_plot.h"

#include <algorithm>
#include <cmath>

#include "figures/axis.h"
#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

Curve loss_curve(const DelaySearch& search) {
    Curve curve;
    curve.x = search.grid();
    curve.y = search.losses();
    curve.style = CurveStyle::kLinePoints;
    curve.line_width = 0.7;
    curve.color = 0;
    curve.label = Message("best model at each delay");
    return curve;
}

Curve mark(double x, double y, int marker, int color, const Message& label) {
    Curve curve;
    curve.x = Vector::Constant(1, x);
    curve.y = Vector::Constant(1, y);
    curve.style = CurveStyle::kPoints;
    curve.marker = marker;
    curve.color = color;
    curve.line_width = 3;
    curve.label = label;
    return curve;
}

double loss_near(const DelaySearch& search, double delay) {
    Index nearest = 0;
    (search.grid().array() - delay).abs().minCoeff(&nearest);
    return search.losses()[nearest];
}

/// "0.1598 ± 0.0036": the error with two digits, the delay with as many decimals.
Message delay_text(const DelaySearch& search) {
    if (!std::isfinite(search.std)) return Message("{}", search.delay);
    const double requested = 1 - std::floor(std::log10(search.std));
    if (requested > 9) return Message("{} ± {}", search.delay, significant(search.std, 2));
    const int places = std::max(0, static_cast<int>(requested));
    return Message("{} ± {}", decimals(search.delay, places), decimals(search.std, places));
}

}  // namespace

Figure delay_plot(const DelaySearch& search) {
    if (search.canceled) throw InvalidArgument("nothing to draw: the search was interrupted");
    Panel panel;
    panel.curves.push_back(loss_curve(search));
    Extent x_extent(false), y_extent(false);
    x_extent.include(panel.curves.front().x);
    x_extent.include(search.delay);
    y_extent.include(panel.curves.front().y);
    y_extent.include(search.loss());
    panel.references = {{false, search.delay, {}, 1}};
    panel.curves.push_back(
        mark(search.delay, search.loss(), style::kOpenCircle, 6, Message("estimate, {} s", delay_text(search))));
    if (search.rival)
        panel.curves.push_back(mark(*search.rival, loss_near(search, *search.rival), style::kCross, style::kGrayColor,
                                    Message("nearly as good, {} s", *search.rival)));
    panel.x_range = x_extent.padded(0.03);
    panel.y_range = y_extent.padded(0.08);
    panel.x_label = axis_label(Message("delay"), "s");
    panel.y_label = Message("mean square error");
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
