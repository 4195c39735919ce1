#include "scripting/objects/present.h"

#include <algorithm>
#include <cmath>

#include "base/reader.h"
#include "scripting/conversions/option_words.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

std::string kind_of(const Model& model) {
    const std::string time = model.G.continuous() ? "continuous-time" : "discrete-time";
    if (model.process) return fmt::format("{} process model {}", time, model.process->structure.text());
    if (model.system) return fmt::format("{} state-space model of order {}", time, model.system->order());
    if (model.polynomial) return time + " polynomial model A y = B/F u + C/D e";
    return time + " transfer function";
}

/// A value with the digits that its standard error bears, of which so many are printed; without an error, `otherwise`.
std::string to_the_error(double value, double error, int error_digits, int otherwise) {
    constexpr int kMost = 9;
    if (!(error > 0) || !std::isfinite(error) || value == 0 || !std::isfinite(value))
        return number_text(value, otherwise);
    const auto place = [](double x) { return static_cast<int>(std::floor(std::log10(std::abs(x)))); };
    return number_text(value, std::clamp(place(value) - place(error) + error_digits, 1, kMost));
}

/// "  ± 0.0312"; an error of exactly zero beside others belongs to a parameter that the search left at its bound.
std::string error_text(const Vector& std, Index index) {
    if (std[index] == 0 && (std.array() > 0).any()) return "  (at its bound)";
    return "  ± " + number_text(std[index], 3);
}

std::string parameter_lines(const Model& model) {
    const ModelParameters parameters = parameters_of(model);
    const bool coloured = model.estimate && model.estimate->errors_are_coloured();
    std::string text = "Parameters:\n";
    for (std::size_t i = 0; i < parameters.names.size(); ++i) {
        const auto index = static_cast<Index>(i);
        const bool has_error = parameters.std.size() > index;
        text += fmt::format("  {:<5} {:>12}", parameters.names[i],
                            to_the_error(parameters.values[index], has_error ? parameters.std[index] : 0, 3, 6));
        if (has_error) text += error_text(parameters.std, index);
        if (coloured && model.estimate->doubts.assessment->std[index] > 0)
            text += fmt::format("  (robust ± {})", number_text(model.estimate->doubts.assessment->std[index], 3));
        text += '\n';
    }
    return text;
}

/// "1.25 ± 0.031", or the value alone when its error is not known, or is none, as the damping of a real pole.
std::string with_error(double value, double error, int digits = 5) {
    const std::string text = to_the_error(value, error, 2, digits);
    return std::isfinite(error) && error > 0 ? text + " ± " + number_text(error, 2) : text;
}

struct PoleColumns {
    int frequency, damping, time;
};

std::string pole_row(const PoleDescription& row, const ModeUncertainty* errors, const PoleColumns& widths) {
    const auto cell = [&](double value, int digits, double ModeUncertainty::*error, int width) {
        const double own_error = errors != nullptr ? errors->*error : std::nan("");
        return fmt::format("  {:>{}}", std::isfinite(value) ? with_error(value, own_error, digits) : "none", width);
    };
    return fmt::format("  {:<24}", complex_text(row.pole)) +
           cell(row.natural_frequency, 5, &ModeUncertainty::natural_frequency_std, widths.frequency) +
           cell(row.damping_ratio, 4, &ModeUncertainty::damping_ratio_std, widths.damping) +
           cell(row.time_constant, 5, &ModeUncertainty::time_constant_std, widths.time) + "\n";
}

/// Steady-state gain and poles of one channel, with their standard errors where they are known.
std::string gain_and_poles(const TransferFunction& G, const std::optional<ModelUncertainty>& uncertainty) {
    const double gain_error = uncertainty ? uncertainty->gain_std : std::nan("");
    std::string text = "Steady-state gain: " + with_error(G.dc_gain(), gain_error) + "\n";
    if (G.pole_count() == 0) return text;
    const PoleColumns widths = uncertainty ? PoleColumns{19, 18, 19} : PoleColumns{17, 8, 17};
    text += fmt::format("{:<26}  {:>{}}  {:>{}}  {:>{}}\n", "Poles:", "frequency (rad/s)", widths.frequency, "damping",
                        widths.damping, "time constant (s)", widths.time);
    const std::vector<PoleDescription> rows = damping(G);
    for (std::size_t i = 0; i < rows.size(); ++i)
        text += pole_row(rows[i], uncertainty ? &uncertainty->modes[i] : nullptr, widths);
    if (uncertainty)
        for (const Message& warning : uncertainty->warnings) text += message_text(warning) + "\n";
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

std::string noise_lines(const NoiseModel& noise) {
    std::string text = "Noise C(q^-1)/D(q^-1) e, e white (weights of the samples before; the present one's is 1):\n";
    const auto add = [&](const char* name, const Vector& p, const Vector& std) {
        for (Index i = 1; i < p.size(); ++i)
            text += fmt::format("  {:<5} {:>12}  ± {}\n", fmt::format("{}{}", name, i),
                                to_the_error(p[i], std[i], 3, 6), number_text(std[i], 3));
    };
    add("c", noise.C, noise.C_std);
    add("d", noise.D, noise.D_std);
    return noise.C.size() + noise.D.size() > 2 ? text : "Noise: taken as white\n";
}

std::string channel_name(const Model& model, std::size_t channel) {
    const std::string input = fmt::format("From input {}", channel % model.inputs() + 1);
    return model.outputs == 1 ? input : fmt::format("{} to output {}", input, channel / model.inputs() + 1);
}

/// Delay, gain and poles of one channel.
std::string channel_lines(const TransferFunction& G, const std::optional<ModelUncertainty>& uncertainty) {
    const std::string delay = G.delay() > 0 ? fmt::format("Delay: {} s\n", number_text(G.delay())) : "";
    return delay + gain_and_poles(G, uncertainty);
}

std::string estimate_lines(const Estimate& estimate) {
    std::string text = fmt::format("Estimated by {}", estimate.method);
    const bool of_response = std::any_of(estimate.numbers.begin(), estimate.numbers.end(),
                                         [](const auto& number) { return number.first == "frequencies"; });
    for (const auto& [name, value] : estimate.numbers) {
        if (of_response) break;  // its message says it
        if (name == "fit_percent")
            text += fmt::format(", fit to the estimation data {} % (simulation)", number_text(value, 4));
        if (name == "noise_variance") text += fmt::format(", noise variance {}", number_text(value, 4));
    }
    text += ".\n";
    if (!estimate.message.empty()) text += in_lua_words(estimate.message) + "\n";
    if (estimate.errors_are_coloured()) text += in_lua_words(estimate.doubts.assessment->verdict) + "\n";
    return text;
}

}  // namespace

std::string channels_text(const Model& model) {
    const std::vector<TransferFunction> channels = channels_of(model);
    if (channels.size() == 1) return to_text(channels.front());
    std::string text;
    for (std::size_t i = 0; i < channels.size(); ++i)
        text += fmt::format("{}{}:\n{}", i > 0 ? "\n" : "", channel_name(model, i), to_text(channels[i]));
    return text;
}

std::string presentation(const Model& model) {
    std::string text = kind_of(model) + "\n" + channels_text(model) + "\n";
    if (model.polynomial) text += polynomial_lines(*model.polynomial);
    if (!model.system) text += parameter_lines(model);
    if (model.estimate && model.estimate->noise) text += noise_lines(*model.estimate->noise);
    if (!model.G.continuous()) text += fmt::format("Sampling time: {} s\n", number_text(model.G.Ts()));
    std::optional<ModelUncertainty> uncertainty;
    if (const auto uncertain = uncertain_model(model)) uncertainty = describe_uncertainty(*uncertain);
    const std::vector<TransferFunction> channels = channels_of(model);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels.size() > 1) text += channel_name(model, i) + ": ";
        text += channel_lines(channels[i], uncertainty);
    }
    if (model.estimate) text += estimate_lines(*model.estimate);
    return text;
}

}  // namespace dynlab::inline scripting
