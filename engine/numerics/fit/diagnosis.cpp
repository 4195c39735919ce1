#include "numerics/fit/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerParameter = 3;

bool is_constant(const Eigen::Ref<const Vector>& x) {
    return (x.array() == x[0]).all();
}

template <class Holds>
bool in_all_experiments(const IdData& data, const Holds& holds) {
    return std::ranges::all_of(data.experiments, holds);
}

/// A constant input is a step from zero at the first sample, when the output begins there as well: less clearly where
/// another input moves the output on.
bool starts_from_rest(const Eigen::Ref<const Vector>& y, bool alone) {
    return std::abs(y[0]) < (alone ? 0.5 : 0.2) * y.cwiseAbs().maxCoeff();
}

void check_inputs(const std::string& method, const IdData& data) {
    if (data.input_count() == 0) throw InvalidArgument("{} needs an input, but the data have no input", method);
    for (Index input = 0; input < data.input_count(); ++input)
        if (in_all_experiments(data, [&](const Experiment& e) { return e.u.col(input).isZero(0); }))
            throw InvalidArgument(
                "{}: the input {} is zero in all samples, so its effect cannot be estimated. Remove this input with "
                "data:select, or use data in which it varies",
                method, data.input_names[static_cast<std::size_t>(input)]);
}

void check_outputs(const std::string& method, const IdData& data) {
    for (Index output = 0; output < data.output_count(); ++output)
        if (in_all_experiments(data, [&](const Experiment& e) { return is_constant(e.y.col(output)); }))
            throw InvalidArgument(data.output_count() == 1
                                      ? Message("{}: the output never changes, so no dynamics can be estimated. Use "
                                                "data in which the output varies",
                                                method)
                                      : Message("{}: output {} never changes, so no dynamics can be estimated. Remove "
                                                "this output with data:select, or use data in which it varies",
                                                method, output + 1));
}

}  // namespace

void check_signals(const std::string& method, const IdData& data) {
    check_inputs(method, data);
    check_outputs(method, data);
}

void check_transfer_data(const std::string& method, const IdData& data, const TransferStructure& structure,
                         Offset offset) {
    structure.validate();
    check_inputs(method, data);
    if (data.input_count() != structure.inputs || data.output_count() != structure.outputs)
        throw InvalidArgument(
            "{}: the model has {} and {}, but the data have {} and {}. Change the orders, or select channels with "
            "data:select",
            method, plural(structure.inputs, "{} input", "{} inputs"),
            plural(structure.outputs, "{} output", "{} outputs"), data.input_count(), data.output_count());
    const Index requested = kSamplesPerParameter * structure.parameter_count();
    if (data.sample_count() < requested)
        throw InvalidArgument("{}: at least {} samples are needed for {} parameters, but the data have {}", method,
                              requested, structure.parameter_count(), data.sample_count());
    for (const TransferChannel& channel : structure.channels)
        for (std::size_t e = 0; e < data.experiments.size(); ++e)
            if (channel.delay >= data.duration(e))
                throw InvalidArgument("{}: the delay of {} {} is not shorter than the data, which last {} {}", method,
                                      channel.delay, data.time_unit, data.duration(e), data.time_unit);
    for (Index input = 0; input < data.input_count(); ++input) {
        const bool alone = data.input_count() == 1;
        const bool rests = in_all_experiments(data, [&](const Experiment& e) {
            return is_constant(e.u.col(input)) && !starts_from_rest(e.y.col(0), alone);
        });
        if (!rests || (alone && offset != Offset::kNone)) continue;
        throw InvalidArgument(
            alone ? Message("{}: the input never changes and the output does not start from rest, so the data contain "
                            "no excitation: vary the input, for instance with prbs",
                            method)
                  : Message(
                        "{}: the input {} never changes and the output does not start from rest, so the effect of the "
                        "input cannot be distinguished from an offset. Exclude this input with data:select, or vary it",
                        method, data.input_names[static_cast<std::size_t>(input)]));
    }
    check_outputs(method, data);
}

void check_sampled_data(const std::string& method, const IdData& data) {
    if (data.input_count() > 0 && !data.regular())
        throw InvalidArgument(
            "{} needs regularly sampled data, but these data are sampled irregularly: interpolate them at equally "
            "spaced instants first (interp1)",
            method);
    check_signals(method, data);
}

void check_sample_count(const std::string& method, Index samples, Index values) {
    if (samples > values) return;
    throw InvalidArgument("{} estimates {} and needs more samples than that, but the data have {}. Use more data",
                          method, plural(values, "{} value", "{} values"), samples);
}

void check_transient(const std::string& method, const IdData& data, const Fit& fit, Index values) {
    if (fit.termination == Termination::kCanceled) return;
    for (const Experiment& experiment : data.experiments)
        for (Index input = 0; input < data.input_count(); ++input)
            if (!is_constant(experiment.u.col(input))) return;
    const Index outputs = data.output_count(), N = data.sample_count() * outputs;
    const auto experiments = outputs * static_cast<Index>(data.experiments.size());
    require_transient(method, {fit.loss, output_variations(data).sum() / static_cast<double>(N),
                               output_powers(data).mean(), N, values, experiments});
}

double shortest_experiment(const IdData& data) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < data.experiments.size(); ++e) shortest = std::min(shortest, data.duration(e));
    return shortest;
}

DelayRange delay_range(const IdData& data, const FitOptions& options) {
    const double shortest = shortest_experiment(data);
    const double largest = options.largest_delay.value_or(std::max(options.least_delay, shortest / 4));
    if (largest >= shortest)
        throw InvalidArgument("{} must be shorter than the data, which last {} {}, but is {} {}",
                              OptionName{"largest_delay"}, shortest, data.time_unit, largest, data.time_unit);
    return {options.least_delay, largest, data.time_unit};
}

namespace {

constexpr double kCancellation = 0.02;  // distance of a pole from a zero, relative to the pole

void warn_of_cancellation(Fit& fit) {
    for (const TransferFunction& G : fit.models) {
        const ComplexVector poles = G.poles(), zeros = G.zeros();
        for (const Complex& zero : zeros)
            for (const Complex& pole : poles)
                if (std::abs(zero - pole) < kCancellation * std::abs(pole)) {
                    fit.warnings.push_back(
                        Message("A pole with a real part of {} and a zero nearly cancel: fewer poles and zeros may be "
                                "sufficient.",
                                significant(pole.real(), 3)));
                    return;
                }
    }
}

Message instability_of_only_channel(UnstableAdvice advice) {
    switch (advice) {
        case UnstableAdvice::kNone:
            return Message("The model is unstable.");
        case UnstableAdvice::kStableOption:
            return Message(
                "The model is unstable. Unless the system is also unstable, {} = true finds the best stable model.",
                OptionName{"stable"});
        case UnstableAdvice::kStableSrivc:
            return Message(
                "The model is unstable. Unless the system is also unstable, srivc with {} = true finds the best stable "
                "model.",
                OptionName{"stable"});
        default:
            return Message(
                "The model is unstable. Unless the system is also unstable, check the controller, the orders and the "
                "cutoff frequency.");
    }
}

/// Loops have one channel: there is no advice about their controller.
Message instability_of_channel(const ChannelPlace& channel, UnstableAdvice advice) {
    const auto& [input, output] = channel;
    if (advice == UnstableAdvice::kStableOption)
        return Message(
            "The model from input {} to output {} is unstable. Unless the system is also unstable, {} = true finds the "
            "best stable model.",
            input, output, OptionName{"stable"});
    if (advice == UnstableAdvice::kStableSrivc)
        return Message(
            "The model from input {} to output {} is unstable. Unless the system is also unstable, srivc with {} = "
            "true finds the best stable model.",
            input, output, OptionName{"stable"});
    return Message("The model from input {} to output {} is unstable.", input, output);
}

void warn_of_instability(Fit& fit, UnstableAdvice advice) {
    for (std::size_t i = 0; i < fit.models.size(); ++i) {
        if (!has_unstable_pole(fit.models[i])) continue;
        const auto channel = channel_place(fit.structure, i);
        fit.warnings.push_back(channel ? instability_of_channel(*channel, advice)
                                       : instability_of_only_channel(advice));
    }
}

Message ambiguity(SimplerModel simpler, Number condition) {
    switch (simpler) {
        case SimplerModel::kFewerBins:
            return Message(
                "The data do not determine all parameters separately (condition number {}): use fewer bins or a richer "
                "input.",
                condition);
        case SimplerModel::kFewerTerms:
            return Message(
                "The data do not determine all parameters separately (condition number {}): use fewer terms or a "
                "richer input.",
                condition);
        case SimplerModel::kFewerFreeParameters:
            return Message(
                "The data do not determine all parameters separately (condition number {}): use fewer free parameters "
                "or a richer input.",
                condition);
        default:
            return Message(
                "The data do not determine all parameters separately (condition number {}): use a simpler structure or "
                "a richer input.",
                condition);
    }
}

/// Of b_0 ... b_n the gain determines the last.
std::vector<std::string> ambiguous_names(const Fit& fit, std::size_t channel) {
    const Index inputs = fit.structure.inputs, place = static_cast<Index>(channel);
    const Index output = place / inputs, input = place % inputs;
    const Index first = fit.structure.numerator_start(output, input), count = fit.models[channel].pole_count();
    std::vector<std::string> names;
    for (Index i = first; i < first + count; ++i) names.push_back(fit.names[static_cast<std::size_t>(i)]);
    names.push_back(fit.names[static_cast<std::size_t>(fit.structure.delay_index(output, input))]);
    return names;
}

void warn_of_ambiguous_delays(Fit& fit, const IdData& data) {
    if (!fit.structure.free_delays) return;
    for (std::size_t i = 0; i < fit.models.size(); ++i) {
        if (!has_ambiguous_delay(fit.models[i], data)) continue;
        const auto channel = channel_place(fit.structure, i);
        const std::vector<std::string> names = ambiguous_names(fit, i);
        withdraw_errors(fit, names);
        std::erase(fit.warnings, ambiguity(SimplerModel::kStructure, significant(fit.condition_number, 2)));
        fit.warnings.push_back(
            channel ? Message("The delay from input {} to output {} is known only to within one sampling time, so {} "
                              "have no standard errors: the input has a zero-order hold and the model has as many "
                              "zeros as poles. Fix the delay with {}, or use one fewer zero.",
                              channel->input, channel->output, listed(names), OptionName{"delay"})
                    : Message("The delay is known only to within one sampling time, so {} have no standard errors: the "
                              "input has a zero-order hold and the model has as many zeros as poles. Fix the delay "
                              "with {}, or use one fewer zero.",
                              listed(names), OptionName{"delay"}));
    }
}

}  // namespace

bool has_ambiguous_delay(const TransferFunction& G, const IdData& data) {
    return data.hold == Hold::kZoh && data.regular() && G.zero_count() == G.pole_count() && G.delay() > 0;
}

void withdraw_errors(Fit& fit, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < fit.names.size(); ++i)
        if (std::ranges::find(names, fit.names[i]) != names.end()) fit.std[static_cast<Index>(i)] = kInfinity;
}

bool inputs_change(const IdData& data) {
    return !in_all_experiments(data, [](const Experiment& e) { return (e.u.rowwise() - e.u.row(0)).isZero(0); });
}

bool withdraw_errors_of_gain(Fit& fit, const IdData& data) {
    if (inputs_change(data) || !fit.start.offset) return false;
    std::vector<std::string> names;
    for (const std::string& name : fit.names)
        if (name == "Kp" || name.front() == 'b' || name.starts_with("Td")) names.push_back(name);
    withdraw_errors(fit, names);
    fit.warnings.push_back(Message(
        "The input never changes. The gain and the delay assume that the input was zero before the first sample, and "
        "have no standard errors. If the input started from another value, subtract that value from {}.",
        listed(data.input_names)));
    return true;
}

void withdraw_errors_at_bounds(Fit& fit, const FitOptions& options) {
    std::vector<std::string> held;
    for (std::size_t i = 0; i < std::min(fit.names.size(), fit.at_bound.size()); ++i)
        if (fit.at_bound[i] && !fit.names[i].starts_with("Td") && !options.fixed.contains(fit.names[i]))
            held.push_back(fit.names[i]);
    if (held.empty()) return;
    withdraw_errors(fit, held);
    fit.warnings.push_back(
        Message("The search ended at a bound of {}, which the data do not determine. Possible causes are a drift, an "
                "offset, or an unsuitable structure.",
                listed(held)));
}

void warn_of_search(Fit& fit, const FitOptions& options) {
    if (fit.termination == Termination::kIterationLimit)
        fit.warnings.push_back(
            Message("The search did not converge within {} = {} iterations; the result is the best point so far.",
                    OptionName{"max_iterations"}, options.max_iterations));
    if (fit.termination == Termination::kCanceled)
        fit.warnings.push_back(Message("The search was interrupted; the result is the best point so far."));
}

std::vector<std::string> undetermined_parameters(const std::vector<std::string>& names, const VectorView& theta,
                                                 const VectorView& std) {
    std::vector<std::string> undetermined;
    for (Index i = 0; i < std::min(theta.size(), std.size()); ++i) {
        const std::string& name = names[static_cast<std::size_t>(i)];
        if (!(std[i] <= std::abs(theta[i])) && !name.starts_with("Td")) undetermined.push_back(name);
    }
    return undetermined;
}

namespace {

/// At an edge of the range.
Message delay_at(const OptionName& edge, double value, const std::string& unit, bool largest,
                 const std::optional<ChannelPlace>& channel) {
    if (channel && largest)
        return Message("The delay from input {} to output {} is {} = {} {}, at the limit of the search: increase {}.",
                       channel->input, channel->output, edge, value, unit, edge);
    if (channel)
        return Message("The delay from input {} to output {} is {} = {} {}, at the limit of the search: decrease {}.",
                       channel->input, channel->output, edge, value, unit, edge);
    return largest
               ? Message("The delay is {} = {} {}, at the limit of the search: increase {}.", edge, value, unit, edge)
               : Message("The delay is {} = {} {}, at the limit of the search: decrease {}.", edge, value, unit, edge);
}

}  // namespace

void warn_of_doubtful_parameters(Fit& fit, SimplerModel simpler) {
    if (!(fit.condition_number < kAmbiguousCondition)) {
        fit.warnings.push_back(ambiguity(simpler, significant(fit.condition_number, 2)));
        return;
    }
    std::vector<std::string> names = undetermined_parameters(fit.names, fit.theta, fit.std);
    std::erase_if(names, [&](const std::string& name) {  // reported with the reason
        return std::isinf(fit.std[std::ranges::find(fit.names, name) - fit.names.begin()]) &&
               !fit.covariance.hasNaN() && fit.covariance.allFinite();
    });
    if (!names.empty())
        fit.warnings.push_back(
            Message("The data do not reliably determine {}: a parameter with a standard error larger than its "
                    "magnitude may be zero.",
                    listed(names)));
}

void warn_of_delay(Fit& fit, double delay, const DelayRange& range, const std::optional<ChannelPlace>& channel) {
    const double edge = 1e-9 * range.largest;
    if (delay >= range.largest - edge && range.largest > range.least)
        fit.warnings.push_back(delay_at(OptionName{"largest_delay"}, range.largest, range.unit, true, channel));
    else if (delay <= range.least + edge && range.least > 0)
        fit.warnings.push_back(delay_at(OptionName{"least_delay"}, range.least, range.unit, false, channel));
    else if (delay <= edge && range.largest > 0 && std::ranges::none_of(fit.fit_percent, explains_little))
        fit.warnings.push_back(
            channel ? Message("No delay from input {} to output {} was detected: use a model without delay.",
                              channel->input, channel->output)
                    : Message("No delay was detected: use a model without delay."));
}

bool explains_little(double fit_percent) {
    return !(std::pow(std::max(0.0, 1 - fit_percent / 100), 2) <= 1 - kLittleExplained / 100);
}

bool has_unstable_pole(const TransferFunction& G) {
    constexpr double kRounding = 1e-9;
    const ComplexVector poles = G.poles();
    if (poles.size() == 0) return false;
    const auto sizes = poles.cwiseAbs();
    return G.continuous() ? (poles.real().array() > kRounding * sizes.maxCoeff()).any()
                          : (sizes.array() > 1 + kRounding).any();
}

std::optional<ChannelPlace> channel_place(const TransferStructure& structure, std::size_t channel) {
    if (structure.single_channel()) return std::nullopt;
    const auto inputs = static_cast<std::size_t>(structure.inputs);
    return ChannelPlace{channel % inputs + 1, channel / inputs + 1};
}

void describe_models(Fit& fit, UnstableAdvice advice) {
    fit.names = fit.structure.parameter_names();
    fit.models = fit.structure.models(fit.theta);
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    warn_of_cancellation(fit);
    warn_of_doubtful_parameters(fit);
    warn_of_instability(fit, advice);
}

void describe_search(Fit& fit, const IdData& data, const FitOptions& options, const DelayRange& range) {
    warn_of_search(fit, options);
    describe_models(fit, options.stable ? UnstableAdvice::kNone : UnstableAdvice::kStableOption);
    for (std::size_t i = 0; i < fit.models.size() && fit.structure.free_delays && range.largest > range.least; ++i)
        warn_of_delay(fit, fit.models[i].delay(), range, channel_place(fit.structure, i));
    warn_of_ambiguous_delays(fit, data);
    withdraw_errors_at_bounds(fit, options);
    withdraw_errors_of_gain(fit, data);
}

bool has_settled(const Fit& fit) {
    return fit.termination == Termination::kConverged || fit.termination == Termination::kNoProgress;
}

Message iteration_count(const Fit& fit) {
    return plural(static_cast<std::int64_t>(fit.trace.size()), "{} iteration", "{} iterations");
}

Message fits_text(const Fit& fit) {
    Message fits = Message("{}", significant(fit.fit_percent[0], 4));
    for (Index output = 1; output < fit.fit_percent.size(); ++output)
        fits = Message("{} % and {}", fits, significant(fit.fit_percent[output], 4));
    return fits;
}

Message simulation_text(const Fit& fit) {
    return Message("fit {} % (simulation)", fits_text(fit));
}

}  // namespace dynlab::inline numerics
