#include "figures/plots/residual_plot.h"

#include <cmath>

#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

constexpr int kInsideColor = 0, kOutsideColor = 6;
constexpr int kInsideMarker = 0, kOutsideMarker = 5;  ///< a filled circle, an open square

Curve stems(const std::vector<double>& lags, const std::vector<double>& values, int color, int marker,
            const Message& label) {
    const auto count = static_cast<Index>(lags.size());
    Curve curve;
    curve.x = Eigen::Map<const Vector>(lags.data(), count);
    curve.y = Eigen::Map<const Vector>(values.data(), count);
    curve.style = CurveStyle::kStems;
    curve.color = color;
    curve.dash = 0;
    curve.marker = marker;
    curve.label = label;
    return curve;
}

/// `correlation` at the lags first, first + 1, ...
Panel correlation_panel(const Vector& correlation, Index first, double bound, double confidence) {
    const auto low = static_cast<double>(first), high = static_cast<double>(first + correlation.size() - 1);
    Panel panel;
    panel.x_range = {low - 0.8, high + 0.8};
    Curve band;
    band.x = Vector{{low - 0.8, high + 0.8}};
    band.y = Vector::Constant(2, -bound);
    band.y_upper = Vector::Constant(2, bound);
    band.style = CurveStyle::kBand;
    band.color = style::kGrayColor;
    band.label = Message("{} % bound", significant(100 * confidence, 4));
    panel.curves = {std::move(band)};
    std::vector<double> lags[2], values[2];
    for (Index i = 0; i < correlation.size(); ++i) {
        const bool outside = std::abs(correlation[i]) > bound;
        lags[outside].push_back(static_cast<double>(first + i));
        values[outside].push_back(correlation[i]);
    }
    if (!lags[0].empty()) panel.curves.push_back(stems(lags[0], values[0], kInsideColor, kInsideMarker, {}));
    if (!lags[1].empty())
        panel.curves.push_back(stems(lags[1], values[1], kOutsideColor, kOutsideMarker, Message("outside the bound")));
    panel.references = {{true, 0, {}, 0}};
    return panel;
}

}  // namespace

Figure residual_plot(const ResidualTests& tests, const IdData& data, double confidence) {
    if (static_cast<Index>(tests.outputs.size()) != data.output_count())
        throw InvalidArgument("the residual tests have {}, but the data have {}",
                              plural(std::ssize(tests.outputs), "{} output", "{} outputs"), data.output_count());
    std::vector<std::vector<Panel>> columns;
    for (std::size_t i = 0; i < tests.outputs.size(); ++i) {
        const OutputResiduals& output = tests.outputs[i];
        if (output.exact) continue;
        auto& column = columns.emplace_back();
        const Vector& own = output.whiteness.correlation;
        column.push_back(correlation_panel(own.tail(own.size() - 1), 1, output.whiteness.bound, confidence));
        column.back().y_label = Message("autocorrelation of the residuals of {}", data.output_names[i]);
        for (const IndependenceTest& test : output.inputs) {
            const Index lags = test.correlation.size() / 2;
            column.push_back(correlation_panel(test.correlation, -lags, test.bound, confidence));
            column.back().y_label =
                Message("correlation with {}", data.input_names[static_cast<std::size_t>(test.input)]);
            const bool explained = output.whiteness.outside > 0 || column.back().curves.back().label.empty();
            if (explained) column.back().legend = LegendPlace::kNone;
        }
        column.back().x_label = Message("lag (samples)");
    }
    if (columns.empty())
        throw InvalidArgument("nothing to draw: the model reproduces every output to within rounding error");
    Figure figure;
    figure.columns = static_cast<int>(columns.size());
    figure.rows = static_cast<int>(columns.front().size());
    for (std::size_t row = 0; row < columns.front().size(); ++row)
        for (const auto& column : columns) figure.panels.push_back(column[row]);
    return figure;
}

}  // namespace dynlab::inline figures
