#include "figures/plots/bode_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "figures/confidence_band.h"
#include "numerics/error.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/sampled_response.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {
namespace {

constexpr Index kBodePoints = 800;

/// Whether a model is drawn as samples of its held input show it.
bool is_held(const NamedModel& model) {
    return model.G.continuous() && model.G.proper() && model.beside.held();
}

ComplexVector shown_response(const NamedModel& model, const Vector& w) {
    if (!is_held(model)) return frequency_response(model.G, w);
    return response_between_samples(model.G, w, model.beside.Ts, model.beside.inter_sample);
}

Vector shown_phase(const NamedModel& model, const Vector& w) {
    if (!is_held(model)) return phase_degrees(model.G, w);
    return phase_degrees_unwrapped(shown_response(model, w), w, model.G.delay());
}

Message shown_name(const NamedModel& model) {
    if (!is_held(model) || model.name.empty()) return model.name;
    return model.beside.inter_sample == InterSample::kZoh ? Message("{}, zero-order hold", model.name)
                                                          : Message("{}, first-order hold", model.name);
}

/// As the measurements say that the models are drawn beside, if they all say the same.
std::vector<NamedModel> beside(std::vector<NamedModel> models, const std::vector<NamedResponse>& responses) {
    if (responses.empty()) return models;
    const MeasuredSamples first{responses.front().data.Ts, responses.front().data.inter_sample};
    for (const NamedResponse& response : responses)
        if (response.data.Ts != first.Ts || response.data.inter_sample != first.inter_sample) return models;
    for (NamedModel& model : models) model.beside = first;
    return models;
}

Vector below_nyquist(const NamedModel& model, const Vector& w) {
    if (model.G.continuous() && !is_held(model)) return w;
    const double Ts = model.G.continuous() ? model.beside.Ts : model.G.Ts();
    const double end = std::numbers::pi / Ts * (1 + 1e-9);
    std::vector<double> kept;
    std::copy_if(w.begin(), w.end(), std::back_inserter(kept), [end](double value) { return value <= end; });
    if (kept.empty())
        throw InvalidArgument(
            "all frequencies are above pi/Ts = {} rad/s, the Nyquist frequency of a discrete-time model or of sampled "
            "data",
            significant(end, 4));
    return Eigen::Map<const Vector>(kept.data(), static_cast<Index>(kept.size()));
}

void add_bands(Panel& magnitude, Panel& phase, const std::vector<NamedModel>& models) {
    constexpr double kMinDecibels = 20, kMinDegrees = 90, kMaxDecibels = 40, kMaxDegrees = 180;
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (!models[i].confidence) continue;
        const auto& [model, level] = *models[i].confidence;
        const FrequencyUncertainty spread = frequency_response_std(model, magnitude.curves[i].x);
        const double width = normal_half_width(level);
        add_confidence_band(magnitude, i, width * spread.magnitude_std, level, kMaxDecibels);
        add_confidence_band(phase, i, width * spread.phase_std, level, kMaxDegrees);
    }
    limit_to_readable(magnitude, models.size(), kMinDecibels);
    limit_to_readable(phase, models.size(), kMinDegrees);
}

/// Logarithmic, from the lowest to the highest frequency of the responses and the corners of the models.
Vector chosen_frequencies(const std::vector<NamedModel>& models, const std::vector<NamedResponse>& responses) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    if (responses.empty()) return joint_frequency_grid(models, kBodePoints);
    for (const NamedResponse& response : responses)
        for (const double w : response.data.w)
            if (w > 0) low = std::min(low, w), high = std::max(high, w);
    if (!(high > 0)) throw InvalidArgument("nothing to draw: no frequency is positive");
    return Vector::LinSpaced(kBodePoints, std::log(low), std::log(high)).array().exp().max(low).min(high);
}

/// Within half a turn of the model, or without jumps.
Vector phase_beside(const FrequencyData& data, const std::vector<NamedModel>& models) {
    constexpr double kTurn = 360;
    Vector phase = phase_degrees_unwrapped(data.response);
    if (models.empty()) return phase;
    const Vector near = shown_phase(models.front(), data.w);
    for (Index k = 0; k < phase.size(); ++k) phase[k] -= kTurn * std::round((phase[k] - near[k]) / kTurn);
    return phase;
}

void add_responses(Panel& magnitude, Panel& phase, const std::vector<NamedResponse>& responses,
                   const std::vector<NamedModel>& models) {
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const FrequencyData& data = responses[i].data;
        Curve curve;
        curve.x = data.w;
        curve.label = responses[i].name;
        curve.style = CurveStyle::kPoints;
        curve.color = static_cast<int>(models.size() + i), curve.marker = static_cast<int>(i);
        curve.y = magnitude_db(data.response);
        magnitude.curves.push_back(curve);
        curve.y = phase_beside(data, models);
        phase.curves.push_back(std::move(curve));
        if (data.variance.size() == 0) continue;
        const Vector relative = normal_half_width(responses[i].level) *
                                (0.5 * data.variance).cwiseSqrt().cwiseQuotient(data.response.cwiseAbs());
        const std::size_t line = magnitude.curves.size() - 1;
        add_confidence_band(magnitude, line, 20 / std::numbers::ln10 * relative, responses[i].level);
        add_confidence_band(phase, line, 180 / std::numbers::pi * relative, responses[i].level);
    }
}

}  // namespace

Vector joint_frequency_grid(const std::vector<NamedModel>& models, Index count) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const NamedModel& model : models) {
        const Vector grid = natural_frequency_grid(model.G);
        low = std::min(low, grid[0]);
        high = std::max(high, grid[grid.size() - 1]);
    }
    return Vector::LinSpaced(count, std::log(low), std::log(high)).array().exp();
}

FrequencyPanels frequency_panels() {
    FrequencyPanels panels;
    panels.magnitude.log_x = panels.phase.log_x = true;
    panels.magnitude.y_label = axis_label(Message("magnitude"), "dB");
    panels.phase.y_label = axis_label(Message("phase"), "°");
    panels.phase.x_label = axis_label(Message("frequency"), "rad/s");
    panels.phase.legend = LegendPlace::kNone;
    return panels;
}

Figure bode_plot(const std::vector<NamedModel>& given, const Vector& w, const std::vector<NamedResponse>& responses) {
    const std::vector<NamedModel> models = beside(given, responses);
    if (models.empty() && responses.empty()) throw InvalidArgument("no models to plot");
    if (w.size() > 0 && !(w.minCoeff() > 0))
        throw InvalidArgument("frequencies must be positive, but the smallest is {}", w.minCoeff());
    const Vector grid = w.size() > 0 ? w : chosen_frequencies(models, responses);
    auto [magnitude, phase] = frequency_panels();
    for (const NamedModel& model : models) {
        Curve curve;
        curve.x = below_nyquist(model, grid);
        curve.label = shown_name(model);
        curve.y = magnitude_db(shown_response(model, curve.x));
        magnitude.curves.push_back(curve);
        curve.y = shown_phase(model, curve.x);
        phase.curves.push_back(std::move(curve));
        if (model.G.continuous()) continue;
        const ReferenceLine end{false, std::numbers::pi / model.G.Ts(), {}, 2};
        if (end.at <= grid.maxCoeff() * 1.001) magnitude.references.push_back(end), phase.references.push_back(end);
    }
    fix_colors(magnitude);
    fix_colors(phase);
    add_bands(magnitude, phase, models);
    add_responses(magnitude, phase, responses, models);
    choose_phase_axis(phase);
    const std::pair<double, double> range{grid.minCoeff(), grid.maxCoeff()};
    if (range.first < range.second) magnitude.x_range = phase.x_range = range;
    Figure figure;
    figure.rows = 2;
    figure.panels = {std::move(magnitude), std::move(phase)};
    return figure;
}

}  // namespace dynlab::inline figures
