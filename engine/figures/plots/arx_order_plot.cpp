#include "figures/plots/arx_order_plot.h"

#include <functional>
#include <map>

#include "figures/axis.h"
#include "figures/plots/order_plot.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

using ArxQuantity = std::function<double(const ArxCandidate&)>;

Curve curve_over_parameters(const ArxSelection& selection, const ArxQuantity& quantity) {
    std::map<int, double> best;
    for (const ArxCandidate& candidate : selection.candidates) {
        const double value = quantity(candidate);
        const auto [entry, is_new] = best.try_emplace(candidate.parameters(), value);
        if (!is_new) entry->second = std::min(entry->second, value);
    }
    Curve curve;
    curve.x.resize(static_cast<Index>(best.size()));
    curve.y.resize(curve.x.size());
    Index i = 0;
    for (const auto& [parameters, value] : best) curve.x[i] = parameters, curve.y[i++] = value;
    curve.style = CurveStyle::kLinePoints;
    return curve;
}

}  // namespace

Figure arx_order_plot(const ArxSelection& selection, ArxCriterion criterion, const OrderChoice& choice) {
    if (selection.candidates.empty()) throw InvalidArgument("nothing to draw: no structure was evaluated");
    Panel panel;
    const bool both = criterion == ArxCriterion::kLoss && selection.validated;
    if (both) {
        panel.curves.push_back(curve_over_parameters(selection, [](const ArxCandidate& c) { return c.loss; }));
        panel.curves.back().label = Message("estimation data");
    }
    panel.curves.push_back(
        curve_over_parameters(selection, [&](const ArxCandidate& c) { return criterion_value(c, criterion); }));
    if (both) panel.curves.back().label = Message("validation data");
    Extent x_extent(false), y_extent(false);
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        panel.curves[i].color = static_cast<int>(i);
        x_extent.include(panel.curves[i].x);
        y_extent.include(panel.curves[i].y);
    }
    const ArxCandidate& chosen = selection.candidates.at(choice.place);
    panel.curves.push_back(mark_of_choice(chosen.parameters(), criterion_value(chosen, criterion)));
    panel.x_range = x_extent.padded(0.08);
    panel.y_range = y_extent.padded(0.1);
    panel.x_tick_step = selection.candidates.back().parameters() > 20 ? 5 : 1;
    panel.x_label = Message("number of parameters");
    panel.y_label = criterion == ArxCriterion::kLoss
                        ? Message("loss")
                        : Message::verbatim(criterion == ArxCriterion::kAic ? "AIC" : "BIC");
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
