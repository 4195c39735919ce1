#include "figures/plots/regression_plot.h"

#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

Curve curve_of(const Vector& x, const Vector& y, const Message& label, CurveStyle style, int color) {
    Curve curve;
    curve.x = x;
    curve.y = y;
    curve.label = label;
    curve.style = style;
    curve.color = color;
    curve.dash = 0;
    return curve;
}

void add_band(Panel& panel, const RegressionPicture& picture, const Vector& lower, const Vector& upper,
              const Message& label, int color) {
    if (lower.size() == 0 && upper.size() == 0) return;
    if (lower.size() != picture.line_x.size() || upper.size() != picture.line_x.size())
        throw InvalidArgument(
            "the {} needs one value for each of the {} points of the line, but the lower edge has {} and the upper "
            "edge has {}",
            label, picture.line_x.size(), lower.size(), upper.size());
    panel.curves.push_back(curve_of(picture.line_x, lower, label, CurveStyle::kBand, color));
    panel.curves.back().y_upper = upper;
}

void add_forecast(Panel& panel, const ForecastPoint& forecast) {
    panel.curves.push_back(
        curve_of(Vector::Constant(2, forecast.x), Vector{{forecast.lower, forecast.upper}}, {}, CurveStyle::kLine, 6));
    panel.curves.back().line_width = 1.2;
    panel.curves.push_back(curve_of(Vector::Constant(1, forecast.x), Vector::Constant(1, forecast.y),
                                    Message("forecast"), CurveStyle::kPoints, 6));
    panel.curves.back().marker = 3;
    if (!forecast.text.empty()) panel.annotations = {{forecast.x, forecast.y, forecast.text, false}};
}

}  // namespace

Figure regression_plot(const RegressionPicture& picture) {
    Panel panel;
    panel.x_label = picture.x_label;
    panel.y_label = picture.y_label;
    if (picture.x.size() > 0) {
        panel.curves.push_back(curve_of(picture.x, picture.y, picture.data_label, CurveStyle::kPoints, 2));
        panel.curves.back().marker = 0;
    }
    if (picture.line_x.size() > 0)
        panel.curves.push_back(curve_of(picture.line_x, picture.line_y, picture.line_label, CurveStyle::kLine, 0));
    add_band(panel, picture, picture.confidence_lower, picture.confidence_upper,
             Message("{} % confidence band", 100 * picture.level), 0);
    add_band(panel, picture, picture.prediction_lower, picture.prediction_upper,
             Message("{} % prediction band", 100 * picture.level), 5);
    if (picture.forecast) add_forecast(panel, *picture.forecast);
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
