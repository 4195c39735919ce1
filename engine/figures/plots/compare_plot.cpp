#include "figures/plots/compare_plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

void check_model_output(const ModelOutput& model, const Matrix& measured) {
    if (model.y.rows() == measured.rows() && model.y.cols() == measured.cols() &&
        model.fit_percent.size() == measured.cols())
        return;
    throw InvalidArgument(
        "the output of model \"{}\" must be {} x {} (number of fit values: {}), as for the data, but it is {} x {} "
        "(number of fit values: {})",
        model.name, measured.rows(), measured.cols(), measured.cols(), model.y.rows(), model.y.cols(),
        model.fit_percent.size());
}

constexpr double kMeasuredWidth = 2.4;  ///< points: seen on both sides of a model's line that lies upon it

Message model_label(const ModelOutput& model, Index output, const std::string& unit) {
    const auto place = static_cast<std::size_t>(output);
    const Number fit = decimals(model.fit_percent[output], 1);
    if (place >= model.offsets.size() || !model.offsets[place]) return Message("{}: {} %", model.name, fit);
    const Number offset = significant(*model.offsets[place], 3);
    return unit.empty() ? Message("{}: {} %, offset {}", model.name, fit, offset)
                        : Message("{}: {} %, offset {} {}", model.name, fit, offset, unit);
}

Curve model_curve(const ModelOutput& model, Index output, const Vector& t, int index, const std::string& unit) {
    static constexpr int kColors[] = {0, 6, 3, 4, 1, 7, 5};  // apart from the gray of the data
    Curve curve;
    curve.x = t;
    curve.y = model.y.col(output);
    curve.label = curve.y.allFinite() ? model_label(model, output, unit) : Message("{}: unstable", model.name);
    curve.color = kColors[index % 7];
    curve.dash = index % 8;
    return curve;
}

/// A run that left all bounds would leave nothing to be seen of the others: the axis is theirs.
void keep_to_the_others(Panel& panel) {
    std::vector<const Curve*> others;
    for (const Curve& curve : panel.curves)
        if (curve.y.allFinite()) others.push_back(&curve);
    if (others.size() == panel.curves.size()) return;
    double low = kInfinity, high = -kInfinity;
    for (const Curve* curve : others)
        low = std::min(low, curve->y.minCoeff()), high = std::max(high, curve->y.maxCoeff());
    const double padding = 0.25 * (high - low);
    if (padding > 0) panel.y_range = {low - padding, high + padding};
}

}  // namespace

Figure compare_plot(const IdData& data, const std::vector<ModelOutput>& models, std::size_t experiment) {
    if (experiment >= data.experiments.size())
        throw InvalidArgument("unknown experiment {}; the number of experiments in the data is {}", experiment + 1,
                              data.experiments.size());
    const Matrix& measured = data.experiments[experiment].y;
    for (const ModelOutput& model : models) check_model_output(model, measured);
    const Vector t = data.time(experiment);
    Figure figure;
    figure.rows = static_cast<int>(measured.cols());
    for (Index output = 0; output < measured.cols(); ++output) {
        Panel panel;
        const auto index = static_cast<std::size_t>(output);
        const std::string unit = index < data.output_units.size() ? data.output_units[index] : "";
        panel.y_label =
            axis_label(Message::verbatim(index < data.output_names.size() ? data.output_names[index]
                                                                          : fmt::format("y_{{{}}}", output + 1)),
                       unit);
        Curve curve;
        curve.x = t;
        curve.y = measured.col(output);
        curve.label = Message("measured");
        curve.color = style::kGrayColor;
        curve.dash = 0;
        curve.line_width = kMeasuredWidth;
        panel.curves.push_back(std::move(curve));
        int number = 0;
        for (const ModelOutput& model : models) panel.curves.push_back(model_curve(model, output, t, number++, unit));
        keep_to_the_others(panel);
        figure.panels.push_back(std::move(panel));
    }
    figure.panels.back().x_label = axis_label(Message("time"), data.time_unit);
    return figure;
}

}  // namespace dynlab::inline figures
