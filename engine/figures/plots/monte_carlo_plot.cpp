#include "figures/plots/monte_carlo_plot.h"

#include <re2/re2.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figures/axis.h"
#include "figures/histogram.h"
#include "figures/style.h"
#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline figures {
namespace {

constexpr double kShownShare = 0.99;     // of all estimates, in the middle
constexpr double kFence = 6;             // quartile distances beside the quartiles, where still more lies far out
constexpr double kRangeExtension = 0.5;  // times the range of those: what lies farther out would squeeze the picture
constexpr double kTruthWidth = 2.5;
constexpr int kTruthColor = 6;  // seen on top of any cloud

/// Finite values of a column.
Vector estimates_of(const MonteCarloResult& result, Index column) {
    std::vector<double> values;
    for (const double value : result.theta.col(column))
        if (std::isfinite(value)) values.push_back(value);
    return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

Index index_of_parameter(const MonteCarloResult& result, const std::string& name) {
    const auto found = std::find(result.names.begin(), result.names.end(), name);
    if (found == result.names.end())
        throw InvalidArgument("{} has no parameter '{}'; the parameters are {}", result.label, name,
                              listed(result.names));
    return found - result.names.begin();
}

/// A parameter's name with its index lowered: a1 as a_{1}, Tp1 as T_{p1}, b0_u2 as b_{0,u2}; other names as they are.
std::string symbol_of(const std::string& name) {
    static const RE2 indexed("(?:([KT])(p[0-9]?|[wzd])|([A-Za-z]+)([0-9]+))(?:_([a-z0-9]+))?", RE2::Latin1);
    std::string process, its_index, letters, number, channel;
    if (!RE2::FullMatch(name, indexed, &process, &its_index, &letters, &number, &channel)) return name;
    return process + letters + "_{" + its_index + number + (channel.empty() ? "" : ",") + channel + "}";
}

void check_study(const MonteCarlo& study) {
    if (study.results.empty()) throw InvalidArgument("the study has no results to draw");
    for (const MonteCarloResult& result : study.results) {
        if (result.estimated == 0) throw InvalidArgument("nothing to draw: {} gave no estimates", result.label);
        if (result.names != study.results.front().names)
            throw InvalidArgument("{} and {} have different parameters ({} and {}): use a separate study for each",
                                  study.results.front().label, result.label, listed(study.results.front().names),
                                  listed(result.names));
    }
}

/// Range of one parameter over all methods: all estimates but those that would squeeze the others, and the truth.
std::pair<double, double> range_of(const std::vector<Vector>& estimates, std::optional<double> truth) {
    std::vector<double> all;
    for (const Vector& values : estimates) all.insert(all.end(), values.begin(), values.end());
    std::sort(all.begin(), all.end());
    const auto index_at = [&](double share) {
        return static_cast<std::size_t>(share * static_cast<double>(all.size() - 1));
    };
    const double lower = all[index_at(0.25)], upper = all[index_at(0.75)], fence = kFence * (upper - lower);
    const double low = std::max(all[index_at((1 - kShownShare) / 2)], lower - fence),
                 high = std::min(all[index_at((1 + kShownShare) / 2)], upper + fence);
    const double margin = kRangeExtension * (high - low);
    Extent extent(false);
    for (const double value : all)
        if (value >= low - margin && value <= high + margin) extent.include(value);
    if (truth) extent.include(*truth);
    return extent.padded(0.05);
}

std::optional<double> truth_of(const MonteCarloResult& result, Index index) {
    if (result.truth.size() == 0) return std::nullopt;
    return result.truth[index];
}

Panel histogram_panel(const Vector& values, std::pair<double, double> range, std::optional<double> truth, int color) {
    std::vector<double> shown;
    for (const double value : values)
        if (value >= range.first && value <= range.second) shown.push_back(value);
    const auto count = static_cast<Index>(shown.size());
    HistogramOptions options;
    options.truth = truth;
    options.truth_label = {};
    // A method all of whose estimates lie outside keeps its panel, with its one bar at the edge.
    if (shown.empty()) shown.push_back(std::clamp(values[0], range.first, range.second));
    Figure figure = histogram(Eigen::Map<const Vector>(shown.data(), static_cast<Index>(shown.size())), options);
    Panel panel = std::move(figure.panels.front());
    if (const Index outside = values.size() - count; outside > 0)
        panel.title = Message("{} of {} outside the axes", outside, values.size());
    panel.x_range = range;
    panel.curves.front().color = color;
    return panel;
}

/// Points of {v : (v - center)' C^-1 (v - center) = -2 ln(1 - level)}, the chi-square quantile for two numbers.
/// `root` is the lower triangle L of C = L L'.
Matrix ellipse(const Eigen::Vector2d& center, const Eigen::Matrix2d& root, double level) {
    constexpr Index kPoints = 91;
    const double radius = std::sqrt(-2 * std::log1p(-level));
    Matrix points(kPoints, 2);
    for (Index i = 0; i < kPoints; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kPoints - 1);
        points.row(i) = (center + radius * root * Eigen::Vector2d(std::cos(angle), std::sin(angle))).transpose();
    }
    return points;
}

/// Line widths of clouds, and with them the size of their markers: as large as still lets so many be seen.
double cloud_width(std::size_t points) {
    return points > 1000 ? 0.6 : points > 300 ? 0.9 : 1.2;
}

Curve cloud(const MonteCarloResult& result, Index x, Index y, int color) {
    std::vector<double> xs, ys;
    for (Index k = 0; k < result.theta.rows(); ++k) {
        if (!std::isfinite(result.theta(k, x))) continue;
        xs.push_back(result.theta(k, x));
        ys.push_back(result.theta(k, y));
    }
    Curve curve;
    curve.x = Eigen::Map<const Vector>(xs.data(), static_cast<Index>(xs.size()));
    curve.y = Eigen::Map<const Vector>(ys.data(), static_cast<Index>(ys.size()));
    curve.style = CurveStyle::kPoints;
    curve.label = Message::verbatim(result.label);
    curve.color = color;
    curve.line_width = cloud_width(xs.size());
    return curve;
}

void add_truth(Panel& panel, const MonteCarloResult& result, Index x, Index y, double level) {
    Curve truth;
    truth.x = Vector::Constant(1, result.truth[x]);
    truth.y = Vector::Constant(1, result.truth[y]);
    truth.style = CurveStyle::kPoints;
    truth.marker = style::kCross;
    truth.color = kTruthColor;
    truth.line_width = kTruthWidth;
    truth.label = Message("true value");
    panel.references = {{true, result.truth[y], {}, 2}, {false, result.truth[x], {}, 2}};
    Eigen::Matrix2d covariance;
    if (result.bound.size() > 0) {
        covariance << result.bound(x, x), result.bound(x, y), result.bound(y, x), result.bound(y, y);
        const auto root = covariance.allFinite() ? cholesky_root(covariance) : std::nullopt;
        if (root) {
            const Matrix points = ellipse({result.truth[x], result.truth[y]}, *root, level);
            Curve curve;
            curve.x = points.col(0);
            curve.y = points.col(1);
            curve.color = style::kGrayColor;
            curve.dash = 0;
            curve.line_width = 1.2;
            curve.label = Message("Cramér–Rao ellipse, {} %", significant(100 * level, 4));
            panel.curves.push_back(std::move(curve));
        }
    }
    panel.curves.push_back(std::move(truth));
}

}  // namespace

Figure monte_carlo_histograms(const MonteCarlo& study) {
    check_study(study);
    const auto d = static_cast<Index>(study.results.front().names.size());
    std::vector<std::pair<double, double>> ranges;
    for (Index i = 0; i < d; ++i) {
        std::vector<Vector> estimates;
        for (const MonteCarloResult& result : study.results) estimates.push_back(estimates_of(result, i));
        ranges.push_back(range_of(estimates, truth_of(study.results.front(), i)));
    }
    Figure figure;
    figure.rows = static_cast<int>(study.results.size());
    figure.columns = static_cast<int>(d);
    for (std::size_t j = 0; j < study.results.size(); ++j) {
        const MonteCarloResult& result = study.results[j];
        for (Index i = 0; i < d; ++i) {
            const auto index = static_cast<std::size_t>(i);
            Panel panel =
                histogram_panel(estimates_of(result, i), ranges[index], truth_of(result, i), static_cast<int>(j));
            if (i == 0) panel.y_label = Message::verbatim(result.label);
            panel.x_label =
                j + 1 == study.results.size() ? Message::verbatim(symbol_of(result.names[index])) : Message();
            figure.panels.push_back(std::move(panel));
        }
    }
    return figure;
}

Message outside_text(const Panel& panel) {
    const auto within = [](const std::optional<std::pair<double, double>>& range, double value) {
        return !range || (value >= range->first && value <= range->second);
    };
    Index outside = 0, all = 0;
    for (const Curve& curve : panel.curves) {
        if (curve.style != CurveStyle::kPoints || curve.marker) continue;  // the true value has a separate marker
        for (Index k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k, ++all)  // not validated yet
            if (!within(panel.x_range, curve.x[k]) || !within(panel.y_range, curve.y[k])) ++outside;
    }
    return outside > 0 ? Message("{} of {} outside the axes", outside, all) : Message();
}

Figure monte_carlo_scatter(const MonteCarlo& study, const std::string& x_name, const std::string& y_name,
                           double level) {
    if (x_name == y_name) throw InvalidArgument("the two parameters of a scatter figure must differ");
    if (!(level > 0 && level < 1))
        throw InvalidArgument("the confidence level must be between 0 and 1, but {} was given", level);
    Panel panel;
    const MonteCarloResult* reference = nullptr;
    std::vector<Vector> xs, ys;
    for (std::size_t j = 0; j < study.results.size(); ++j) {
        const MonteCarloResult& result = study.results[j];
        if (result.estimated == 0) continue;
        panel.curves.push_back(
            cloud(result, index_of_parameter(result, x_name), index_of_parameter(result, y_name), static_cast<int>(j)));
        xs.push_back(panel.curves.back().x);
        ys.push_back(panel.curves.back().y);
        if (reference == nullptr && result.truth.size() > 0) reference = &result;
    }
    if (panel.curves.empty()) throw InvalidArgument("nothing to draw: no method gave estimates");
    std::optional<double> true_x, true_y;
    if (reference != nullptr) {
        const Index x = index_of_parameter(*reference, x_name), y = index_of_parameter(*reference, y_name);
        true_x = reference->truth[x], true_y = reference->truth[y];
        add_truth(panel, *reference, x, y, level);
    }
    panel.x_range = range_of(xs, true_x);
    panel.y_range = range_of(ys, true_y);
    panel.title = outside_text(panel);
    panel.x_label = Message::verbatim(symbol_of(x_name));
    panel.y_label = Message::verbatim(symbol_of(y_name));
    Figure figure(std::move(panel));
    figure.height_cm = 9;
    return figure;
}

}  // namespace dynlab::inline figures
