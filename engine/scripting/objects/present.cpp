#include "scripting/objects/present.h"

#include <algorithm>
#include <cmath>

#include "base/reader.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

Message kind_of(const Model& model) {
    const bool continuous = model.G.continuous();
    if (model.process) return Message("continuous-time process model {}", model.process->structure.text());
    if (model.system)
        return continuous ? Message("continuous-time state-space model of order {}", model.system->order())
                          : Message("discrete-time state-space model of order {}", model.system->order());
    if (model.polynomial) return Message("discrete-time polynomial model A y = B/F u + C/D e");
    return continuous ? Message("continuous-time transfer function") : Message("discrete-time transfer function");
}

/// Builds the text for one reader.
class Presentation {
  public:
    explicit Presentation(const Reader& reader) : reader_(reader) {}
    std::string of(const Model& model) const;
    std::string channels(const Model& model) const;

  private:
    std::string text(const Message& message) const { return message_text(message, reader_); }
    std::string text(double value, int digits = 5) const { return number_text(significant(value, digits), reader_); }
    std::string to_the_error(double value, double error, int error_digits, int otherwise) const;
    std::string with_error(double value, double error, int digits = 5) const;
    std::string error_of(const Vector& std, Index index) const;
    std::string parameter_lines(const Model& model) const;
    struct PoleColumns {
        int frequency, damping, time;
    };
    std::string pole_row(const PoleDescription& row, const ModeUncertainty* errors, const PoleColumns& widths) const;
    std::string gain_and_poles(const TransferFunction& G, const std::optional<ModelUncertainty>& uncertainty) const;
    std::string polynomial_lines(const PolynomialModel& model) const;
    std::string noise_lines(const NoiseModel& noise) const;
    std::string channel_lines(const TransferFunction& G, const std::optional<ModelUncertainty>& uncertainty) const;
    std::string estimate_lines(const Estimate& estimate) const;

    Reader reader_;
};

/// A value with the digits that its standard error bears, of which so many are printed; without an error, `otherwise`.
std::string Presentation::to_the_error(double value, double error, int error_digits, int otherwise) const {
    constexpr int kMax = 9;
    if (!(error > 0) || !std::isfinite(error) || value == 0 || !std::isfinite(value)) return text(value, otherwise);
    const auto place = [](double x) { return static_cast<int>(std::floor(std::log10(std::abs(x)))); };
    return text(value, std::clamp(place(value) - place(error) + error_digits, 1, kMax));
}

/// "  ± 0.0312"; an error of exactly zero beside others belongs to a parameter that the search left at its bound.
std::string Presentation::error_of(const Vector& std, Index index) const {
    if (std[index] == 0 && (std.array() > 0).any()) return "  " + text(Message("(at its bound)"));
    if (std::isinf(std[index])) return "  " + text(Message("(not determined by the data)"));
    return "  ± " + text(std[index], 3);
}

std::string Presentation::parameter_lines(const Model& model) const {
    const ModelParameters parameters = parameters_of(model);
    const auto colored = model.estimate ? model.estimate->color() : nullptr;
    std::string lines = text(Message("Parameters:")) + "\n";
    for (std::size_t i = 0; i < parameters.names.size(); ++i) {
        const auto index = static_cast<Index>(i);
        const bool has_error = parameters.std.size() > index;
        lines += fmt::format("  {:<5} {:>12}", parameters.names[i],
                             to_the_error(parameters.values[index], has_error ? parameters.std[index] : 0, 3, 6));
        if (has_error) lines += error_of(parameters.std, index);
        if (colored && colored->std[index] > 0 && std::isfinite(colored->std[index]))
            lines += "  " + text(Message("(robust ± {})", significant(colored->std[index], 3)));
        lines += '\n';
    }
    return lines;
}

/// Whether the data do not determine the steady-state gain: Kp, or the last coefficient of B.
bool gain_is_open(const Estimate& estimate) {
    bool open = false;
    for (std::size_t i = 0; i < estimate.names.size(); ++i)
        if (estimate.names[i] == "Kp" || estimate.names[i].front() == 'b')
            open = std::isinf(estimate.std()[static_cast<Index>(i)]);
    return open;
}

/// "1.25 ± 0.031", or the value alone when its error is not known, or is none, as the damping of a real pole.
std::string Presentation::with_error(double value, double error, int digits) const {
    const std::string number = to_the_error(value, error, 2, digits);
    return std::isfinite(error) && error > 0 ? number + " ± " + text(error, 2) : number;
}

std::string Presentation::pole_row(const PoleDescription& row, const ModeUncertainty* errors,
                                   const PoleColumns& widths) const {
    const auto cell = [&](double value, int digits, double ModeUncertainty::*error, int width) {
        const double own_error = errors != nullptr ? errors->*error : std::nan("");
        return fmt::format("  {:>{}}",
                           std::isfinite(value) ? with_error(value, own_error, digits) : text(Message("none")), width);
    };
    return fmt::format("  {:<24}", complex_text(row.pole, reader_)) +
           cell(row.natural_frequency, 5, &ModeUncertainty::natural_frequency_std, widths.frequency) +
           cell(row.damping_ratio, 4, &ModeUncertainty::damping_ratio_std, widths.damping) +
           cell(row.time_constant, 5, &ModeUncertainty::time_constant_std, widths.time) + "\n";
}

/// Steady-state gain and poles of one channel, with their standard errors where they are known.
std::string Presentation::gain_and_poles(const TransferFunction& G,
                                         const std::optional<ModelUncertainty>& uncertainty) const {
    const double gain_error = uncertainty ? uncertainty->gain_std : std::nan("");
    std::string lines = text(Message("Steady-state gain: {}", with_error(G.dc_gain(), gain_error))) + "\n";
    if (G.pole_count() == 0) return lines;
    const PoleColumns widths = uncertainty ? PoleColumns{19, 18, 19} : PoleColumns{17, 8, 17};
    lines += fmt::format("{:<26}  {:>{}}  {:>{}}  {:>{}}\n", text(Message("Poles:")),
                         text(Message("frequency (rad/s)")), widths.frequency, text(Message("damping")), widths.damping,
                         text(Message("time constant (s)")), widths.time);
    const std::vector<PoleDescription> rows = damping(G);
    for (std::size_t i = 0; i < rows.size(); ++i)
        lines += pole_row(rows[i], uncertainty ? &uncertainty->modes[i] : nullptr, widths);
    if (uncertainty)
        for (const Message& warning : uncertainty->warnings) lines += text(warning) + "\n";
    return lines;
}

std::string Presentation::polynomial_lines(const PolynomialModel& model) const {
    std::string lines =
        text(Message("Polynomials (coefficients in ascending powers of q^-1; polynomials not shown are 1):")) + "\n";
    const auto add = [&](const std::string& name, const Vector& p) {
        if (p.size() > 1 || p[0] != 1) lines += fmt::format("  {:<5} {}\n", name, vector_text(p, reader_));
    };
    add("A", model.A);
    for (std::size_t i = 0; i < model.B.size(); ++i) {
        const std::string ending = model.B.size() > 1 ? fmt::format("{{{}}}", i + 1) : "";
        add("B" + ending, model.B[i]);
        add("F" + ending, model.F[i]);
    }
    add("C", model.C);
    add("D", model.D);
    return lines;
}

std::string Presentation::noise_lines(const NoiseModel& noise) const {
    if (noise.C.size() + noise.D.size() <= 2) return text(Message("Noise: assumed white")) + "\n";
    std::string lines = text(Message("Noise model C(q^-1)/D(q^-1) e with white noise e (coefficients of C and D; the "
                                     "leading coefficients are 1):")) +
                        "\n";
    const auto add = [&](const char* name, const Vector& p, const Vector& std) {
        for (Index i = 1; i < p.size(); ++i)
            lines += fmt::format("  {:<5} {:>12}{}\n", fmt::format("{}{}", name, i), to_the_error(p[i], std[i], 3, 6),
                                 error_of(std, i));
    };
    add("c", noise.C, noise.C_std);
    add("d", noise.D, noise.D_std);
    return lines;
}

Message channel_name(const Model& model, std::size_t channel) {
    const std::size_t input = channel % model.inputs() + 1;
    return model.outputs == 1 ? Message("From input {}:", input)
                              : Message("From input {} to output {}:", input, channel / model.inputs() + 1);
}

/// Delay, gain and poles of one channel.
std::string Presentation::channel_lines(const TransferFunction& G,
                                        const std::optional<ModelUncertainty>& uncertainty) const {
    const std::string delay = G.delay() > 0 ? text(Message("Delay: {} s", G.delay())) + "\n" : "";
    return delay + gain_and_poles(G, uncertainty);
}

std::string Presentation::estimate_lines(const Estimate& estimate) const {
    const auto number = [&estimate](std::string_view name) {
        const std::optional<double> found = estimate.report().number(name);
        return found ? std::optional(significant(*found, 4)) : std::nullopt;
    };
    // The message of an estimate from a frequency response says how well it fits.
    const bool of_response = number("frequencies").has_value();
    const std::optional<Number> fit = of_response ? std::nullopt : number("fit_percent"),
                                variance = of_response ? std::nullopt : number("noise_variance");
    std::string lines;
    if (fit && variance)
        lines = text(Message("Estimated by {}. Fit to the estimation data: {} % (simulation). Noise variance: {}.",
                             estimate.method, *fit, *variance));
    else if (fit)
        lines = text(Message("Estimated by {}. Fit to the estimation data: {} % (simulation).", estimate.method, *fit));
    else if (variance)
        lines = text(Message("Estimated by {}. Noise variance: {}.", estimate.method, *variance));
    else
        lines = text(Message("Estimated by {}.", estimate.method));
    lines += "\n";
    if (fit && !estimate.report().simulated.empty()) lines += text(estimate.report().simulated) + "\n";
    if (const Message message = estimate.full_message(); !message.empty()) lines += text(message) + "\n";
    if (const auto colored = estimate.color()) lines += text(colored->verdict) + "\n";
    return lines;
}

std::string Presentation::channels(const Model& model) const {
    const std::vector<TransferFunction> each = channels_of(model);
    if (each.size() == 1) return to_text(each.front());
    std::string lines;
    for (std::size_t i = 0; i < each.size(); ++i)
        lines += (i > 0 ? "\n" : "") + text(channel_name(model, i)) + "\n" + to_text(each[i]);
    return lines;
}

std::string Presentation::of(const Model& model) const {
    std::string lines = text(kind_of(model)) + "\n" + channels(model) + "\n";
    if (model.polynomial) lines += polynomial_lines(*model.polynomial);
    if (!model.system) lines += parameter_lines(model);
    if (model.estimate && model.estimate->noise) lines += noise_lines(*model.estimate->noise);
    if (!model.G.continuous()) lines += text(Message("Sampling time: {} s", model.G.Ts())) + "\n";
    std::optional<ModelUncertainty> uncertainty;
    if (const auto uncertain = uncertain_model(model)) uncertainty = describe_uncertainty(*uncertain);
    if (uncertainty && gain_is_open(*model.estimate)) uncertainty->gain_std = std::nan("");
    const std::vector<TransferFunction> each = channels_of(model);
    for (std::size_t i = 0; i < each.size(); ++i) {
        if (each.size() > 1) lines += text(channel_name(model, i)) + " ";
        lines += channel_lines(each[i], uncertainty);
    }
    if (model.estimate) lines += estimate_lines(*model.estimate);
    return lines;
}

}  // namespace

std::string channels_text(const Model& model, const Reader& reader) {
    return Presentation(reader).channels(model);
}

std::string presentation(const Model& model, const Reader& reader) {
    return Presentation(reader).of(model);
}

}  // namespace dynlab::inline scripting
