#include "figures/plots/cross_validation_plot.h"

#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline figures {

Figure cross_validation_plot(const CrossValidation& result, const std::vector<std::string>& output_names) {
    const Index folds = result.fit_percent.rows(), outputs = result.fit_percent.cols();
    if (folds == 0) throw InvalidArgument("nothing to draw: no part was validated");
    Panel panel;
    panel.x_label = Message("omitted part");
    panel.y_label = axis_label(Message("fit of the simulation"), "%");
    const auto end = static_cast<double>(folds);
    panel.x_range = {0.5, end + 0.5};
    if (!result.fit_percent.array().isFinite().any())
        throw InvalidArgument("nothing to draw: the models are unstable on every part");
    for (Index i = 0; i < outputs; ++i) {
        if (!result.fit_percent.col(i).array().isFinite().any()) continue;
        Curve points;
        points.x = Vector::LinSpaced(folds, 1, end);
        points.y = result.fit_percent.col(i);
        points.style = CurveStyle::kPoints;
        points.color = static_cast<int>(i);
        points.line_width = 1.4;
        if (outputs > 1) points.label = Message::verbatim(output_names[static_cast<std::size_t>(i)]);
        panel.curves.push_back(std::move(points));
    }
    for (Index i = 0; i < outputs; ++i) {
        if (!std::isfinite(result.mean[i])) continue;
        Curve mean;
        mean.x = Vector{{0.5, end + 0.5}};
        mean.y = Vector::Constant(2, result.mean[i]);
        mean.color = static_cast<int>(i);
        mean.dash = 1 + static_cast<int>(i);
        mean.line_width = 0.7;
        mean.label = Message("mean {} %", decimals(result.mean[i], 1));
        panel.curves.push_back(std::move(mean));
    }
    return Figure(std::move(panel));
}

}  // namespace dynlab::inline figures
