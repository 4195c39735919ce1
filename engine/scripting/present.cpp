#include "scripting/present.h"

#include <algorithm>
#include <cmath>

#include "scripting/text_form.h"

namespace dynlab {
namespace {

std::string kind_of(const Model& model) {
    const std::string time = model.G.continuous() ? "continuous-time" : "discrete-time";
    if (model.process) return fmt::format("{} process model {}", time, model.process->structure.text());
    if (model.polynomial) return time + " polynomial model A y = B/F u + C/D e";
    return time + " transfer function";
}

std::string parameter_lines(const Model& model) {
    const ModelParameters parameters = parameters_of(model);
    const bool coloured = model.estimate && model.estimate->errors_are_coloured();
    std::string text = "Parameters:\n";
    for (std::size_t i = 0; i < parameters.names.size(); ++i) {
        const auto place = static_cast<Index>(i);
        text += fmt::format("  {:<5} {:>12}", parameters.names[i], number_text(parameters.values[place], 6));
        if (parameters.std.size() > place) text += fmt::format("  +- {}", number_text(parameters.std[place], 3));
        if (coloured) text += fmt::format("  (robust +- {})", number_text(model.estimate->assessment->std[place], 3));
        text += '\n';
    }
    return text;
}

std::string pole_lines(const TransferFunction& G) {
    if (G.pole_count() == 0) return {};
    std::string text =
        fmt::format("{:<26}{:>17}  {:>8}  {:>17}\n", "Poles:", "frequency (rad/s)", "damping", "time constant (s)");
    for (const PoleDescription& row : damping(G)) {
        const std::string time_constant = std::isfinite(row.time_constant) ? number_text(row.time_constant) : "none";
        text += fmt::format("  {:<24}{:>17}  {:>8}  {:>17}\n", complex_text(row.pole),
                            number_text(row.natural_frequency), number_text(row.damping_ratio, 4), time_constant);
    }
    return text;
}

std::string polynomial_lines(const PolynomialModel& model) {
    std::string text;
    const auto add = [&](const std::string& name, const Vector& p) {
        if (p.size() > 1 || p[0] != 1) text += fmt::format("  {:<5} {}\n", name, vector_text(p));
    };
    add("A", model.A);
    for (std::size_t i = 0; i < model.B.size(); ++i) {
        const std::string ending = model.B.size() > 1 ? fmt::format("{{{}}}", i + 1) : "";
        add("B" + ending, model.B[i]);
        add("F" + ending, model.F[i]);
    }
    add("C", model.C);
    add("D", model.D);
    return "Polynomials (weights of the present sample, the one before, ...; those not shown are 1):\n" + text;
}

/// Delay, gain and poles of one channel.
std::string channel_lines(const TransferFunction& G) {
    std::string text;
    if (G.delay() > 0) text += fmt::format("Delay: {} s\n", number_text(G.delay()));
    text += fmt::format("Steady-state gain: {}\n", number_text(G.dc_gain()));
    return text + pole_lines(G);
}

std::string estimate_lines(const Estimate& estimate) {
    std::string text = fmt::format("Estimated by {}", estimate.method);
    for (const auto& [name, value] : estimate.numbers) {
        if (name == "fit_percent")
            text += fmt::format(", fit to the estimation data {} % (simulation)", number_text(value, 4));
        if (name == "noise_variance") text += fmt::format(", noise variance {}", number_text(value, 4));
    }
    text += ".\n";
    if (!estimate.message.empty()) text += estimate.message + "\n";
    if (estimate.errors_are_coloured()) text += estimate.assessment->verdict + "\n";
    return text;
}

}  // namespace

std::string channels_text(const Model& model) {
    const std::vector<TransferFunction> channels = channels_of(model);
    if (channels.size() == 1) return to_text(channels.front());
    std::string text;
    for (std::size_t i = 0; i < channels.size(); ++i)
        text += fmt::format("{}From input {}:\n{}", i > 0 ? "\n" : "", i + 1, to_text(channels[i]));
    return text;
}

std::string presentation(const Model& model) {
    std::string text = kind_of(model) + "\n" + channels_text(model) + "\n";
    if (model.polynomial) text += polynomial_lines(*model.polynomial);
    text += parameter_lines(model);
    if (!model.G.continuous()) text += fmt::format("Sampling time: {} s\n", number_text(model.G.Ts()));
    const std::vector<TransferFunction> channels = channels_of(model);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels.size() > 1) text += fmt::format("From input {}: ", i + 1);
        text += channel_lines(channels[i]);
    }
    if (model.estimate) text += estimate_lines(*model.estimate);
    return text;
}

}  // namespace dynlab
