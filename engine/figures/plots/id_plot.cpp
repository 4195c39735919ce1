#include "figures/plots/id_plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

struct Channel {
    bool output;
    Index number;
};

Message label_of(const Channel& channel, const IdData& data) {
    const auto& names = channel.output ? data.output_names : data.input_names;
    const auto& units = channel.output ? data.output_units : data.input_units;
    const auto index = static_cast<std::size_t>(channel.number);
    const std::string name = index < names.size() && !names[index].empty()
                                 ? names[index]
                                 : fmt::format("{}_{{{}}}", channel.output ? "y" : "u", channel.number + 1);
    return axis_label(Message::verbatim(name), index < units.size() ? units[index] : "");
}

void check_channels(const std::vector<const IdData*>& data, const std::vector<std::string>& labels) {
    if (data.empty()) throw InvalidArgument("no data to plot");
    if (!labels.empty() && labels.size() != data.size())
        throw InvalidArgument(
            "the plot needs one label for each of the {} data objects, but the number of labels is {}", data.size(),
            labels.size());
    for (const IdData* object : data)
        if (object->output_count() != data.front()->output_count() ||
            object->input_count() != data.front()->input_count())
            throw InvalidArgument(
                "data objects in one plot must have the same channels, but one object has {} and {} and another has {} "
                "and {}",
                plural(data.front()->output_count(), "{} output", "{} outputs"),
                plural(data.front()->input_count(), "{} input", "{} inputs"), object->output_count(),
                object->input_count());
}

bool draws_the_same(const Curve& a, const Curve& b) {
    return a.style == b.style && a.x.size() == b.x.size() && a.x == b.x && a.y == b.y;
}

/// Adds a curve to the panel. An input that the panel already shows is not repeated, but drawn in gray as it belongs to
/// several.
void add_curve(Panel& panel, Curve curve, bool output) {
    const auto same = std::find_if(panel.curves.begin(), panel.curves.end(),
                                   [&](const Curve& other) { return !output && draws_the_same(curve, other); });
    if (same == panel.curves.end())
        panel.curves.push_back(std::move(curve));
    else
        same->color = style::kGrayColor;
}

/// The reference that a loop's output is to follow.
Curve reference_curve(const IdData& data, std::size_t experiment, Index number) {
    Curve curve;
    curve.x = data.time(experiment);
    curve.y = data.experiments[experiment].r.col(number);
    curve.label = Message("reference");
    curve.color = style::kGrayColor;
    if (data.hold == Hold::kZoh) curve.style = CurveStyle::kStairs;
    return curve;
}

Panel panel_of(const Channel& channel, const std::vector<const IdData*>& data, const std::vector<std::string>& labels) {
    Panel panel;
    panel.y_label = label_of(channel, *data.front());
    int index = 0;
    for (std::size_t i = 0; i < data.size(); ++i)
        for (std::size_t k = 0; k < data[i]->experiments.size(); ++k) {
            const Experiment& experiment = data[i]->experiments[k];
            Curve curve;
            curve.x = data[i]->time(k);
            curve.y = (channel.output ? experiment.y : experiment.u).col(channel.number);
            if (!channel.output && data[i]->hold == Hold::kZoh) curve.style = CurveStyle::kStairs;
            if (!labels.empty())
                curve.label = Message::verbatim(labels[i]);
            else if (data.size() > 1)
                curve.label = Message("data {}", i + 1);
            if (data[i]->experiments.size() > 1) {
                const Message name =
                    experiment.name.empty() ? Message("experiment {}", k + 1) : Message::verbatim(experiment.name);
                curve.label = curve.label.empty() ? name : Message("{}, {}", curve.label, name);
            }
            curve.color = index++;
            add_curve(panel, std::move(curve), channel.output);
            if (channel.output && channel.number < experiment.r.cols())
                panel.curves.push_back(reference_curve(*data[i], k, channel.number));
        }
    return panel;
}

std::pair<double, double> common_time_range(const std::vector<const IdData*>& data) {
    std::pair<double, double> range{1e300, -1e300};
    for (const IdData* object : data)
        for (std::size_t k = 0; k < object->experiments.size(); ++k) {
            const Vector t = object->time(k);
            range = {std::min(range.first, t[0]), std::max(range.second, t[t.size() - 1])};
        }
    return range;
}

}  // namespace

Figure id_plot(const std::vector<const IdData*>& data, const std::vector<std::string>& labels) {
    check_channels(data, labels);
    std::vector<Channel> channels;
    for (Index i = 0; i < data.front()->output_count(); ++i) channels.push_back({true, i});
    for (Index i = 0; i < data.front()->input_count(); ++i) channels.push_back({false, i});
    Figure figure;
    figure.rows = static_cast<int>(channels.size());
    const auto range = common_time_range(data);
    for (const Channel& channel : channels) {
        figure.panels.push_back(panel_of(channel, data, labels));
        Panel& panel = figure.panels.back();
        if (range.first < range.second) panel.x_range = range;
        if (figure.panels.size() > 1) panel.legend = LegendPlace::kNone;  // the uppermost panel's holds for all
    }
    figure.panels.back().x_label = axis_label(Message("time"), data.front()->time_unit);
    return figure;
}

}  // namespace dynlab::inline figures
