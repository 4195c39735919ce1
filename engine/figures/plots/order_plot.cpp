#include "figures/plots/order_plot.h"

#include <cmath>
#include <map>

#include "figures/axis.h"
#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

const OrderMeasure& drawn_measure(OrderCriterion criterion, bool validated) {
    if (criterion == OrderCriterion::kValidationFit && !validated)
        throw InvalidArgument("no validation fit to draw: no validation data were given");
    if (criterion != OrderCriterion::kRecommended) return order_measure(criterion);
    return order_measure(validated ? OrderCriterion::kValidationFit : OrderCriterion::kBic);
}

Message label_of(const OrderMeasure& measure) {
    if (measure.criterion == OrderCriterion::kFit) return axis_label(Message("fit"), "%");
    if (measure.criterion == OrderCriterion::kValidationFit) return axis_label(Message("validation fit"), "%");
    return Message::verbatim(measure.criterion == OrderCriterion::kRSquared ? "R_T^2" : measure.word);
}

bool only_delays_differ(const OrderSelection& selection) {
    const OrderCandidate& first = selection.candidates.front();
    for (const OrderCandidate& candidate : selection.candidates)
        if (candidate.poles != first.poles || candidate.zeros != first.zeros) return false;
    return selection.candidates.size() > 1;
}

/// For each curve (number of zeros) the best value at each x.
std::map<int, std::map<double, double>> best_values(const OrderSelection& selection, const OrderMeasure& measure,
                                                    bool over_delay) {
    std::map<int, std::map<double, double>> curves;
    for (const OrderCandidate& candidate : selection.candidates) {
        if (!candidate.failure.empty()) continue;
        const double value = measure.value(candidate), x = over_delay ? candidate.delay : candidate.poles;
        if (!std::isfinite(value)) continue;
        auto [entry, is_new] = curves[candidate.zeros].try_emplace(x, value);
        if (!is_new && (measure.larger_is_better ? value > entry->second : value < entry->second))
            entry->second = value;
    }
    return curves;
}

Curve curve_of(const std::map<double, double>& values, int zeros, int index) {
    Curve curve;
    curve.x.resize(static_cast<Index>(values.size()));
    curve.y.resize(curve.x.size());
    Index i = 0;
    for (const auto& [x, y] : values) curve.x[i] = x, curve.y[i++] = y;
    curve.style = CurveStyle::kLinePoints;
    curve.color = index;
    curve.label = zeros == 0 ? Message("no zeros") : plural(zeros, "{} zero", "{} zeros");
    return curve;
}

}  // namespace

Curve mark_of_choice(double x, double y) {
    Curve mark;
    mark.x = Vector::Constant(1, x);
    mark.y = Vector::Constant(1, y);
    mark.style = CurveStyle::kPoints;
    mark.marker = style::kOpenCircle;
    mark.color = 6;
    mark.line_width = 3;
    mark.label = Message("chosen");
    return mark;
}

Figure order_plot(const OrderSelection& selection, OrderCriterion criterion, const OrderChoice& choice) {
    const OrderMeasure& measure = drawn_measure(criterion, selection.validated);
    const bool over_delay = only_delays_differ(selection);
    Panel panel;
    Extent x_extent(false), y_extent(false);
    int index = 0;
    for (const auto& [zeros, values] : best_values(selection, measure, over_delay)) {
        if (values.empty()) continue;
        panel.curves.push_back(curve_of(values, zeros, index++));
        x_extent.include(panel.curves.back().x);
        y_extent.include(panel.curves.back().y);
    }
    if (panel.curves.empty()) throw InvalidArgument("nothing to draw: no structure could be estimated");
    const OrderCandidate& chosen = selection.candidates.at(choice.place);
    if (const double value = measure.value(chosen); std::isfinite(value))
        panel.curves.push_back(mark_of_choice(over_delay ? chosen.delay : chosen.poles, value));
    panel.x_range = x_extent.padded(0.08);
    panel.y_range = y_extent.padded(0.1);
    if (!over_delay) panel.x_tick_step = 1;
    panel.x_label = over_delay ? axis_label(Message("delay"), "s") : Message("number of poles");
    panel.y_label = label_of(measure);
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
