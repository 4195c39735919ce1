#include "numerics/fit/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerParameter = 3;

std::string numbered(const char* what, Index place, Index count) {
    return count == 1 ? std::string("the ") + what : std::string(what) + " " + std::to_string(place + 1);
}

bool is_constant(const Eigen::Ref<const Vector>& x) {
    return (x.array() == x[0]).all();
}

template <class Holds>
bool in_all_experiments(const IdData& data, const Holds& holds) {
    return std::ranges::all_of(data.experiments, holds);
}

/// A constant input is a step from zero at the first sample, when the output begins there as well.
bool starts_from_rest(const Eigen::Ref<const Vector>& y) {
    return std::abs(y[0]) < 0.5 * y.cwiseAbs().maxCoeff();
}

void check_inputs(const std::string& method, const IdData& data) {
    if (data.input_count() == 0) throw InvalidArgument(method + " needs an input, and the data have no input");
    for (Index input = 0; input < data.input_count(); ++input)
        if (in_all_experiments(data, [&](const Experiment& e) { return e.u.col(input).isZero(0); }))
            throw InvalidArgument(method + ": the input " + data.input_names[static_cast<std::size_t>(input)] +
                                  " is zero throughout: it does not excite the system, and its effect cannot be "
                                  "estimated");
}

void check_outputs(const std::string& method, const IdData& data) {
    for (Index output = 0; output < data.output_count(); ++output)
        if (in_all_experiments(data, [&](const Experiment& e) { return is_constant(e.y.col(output)); }))
            throw InvalidArgument(method + ": " + numbered("output", output, data.output_count()) +
                                  " never changes, so no dynamics can be estimated");
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
        throw InvalidArgument(method + ": the model has " + std::to_string(structure.inputs) + " input(s) and " +
                              std::to_string(structure.outputs) + " output(s), and the data have " +
                              std::to_string(data.input_count()) + " and " + std::to_string(data.output_count()));
    const Index wanted = kSamplesPerParameter * structure.parameter_count();
    if (data.sample_count() < wanted)
        throw InvalidArgument(method + ": at least " + std::to_string(wanted) + " samples are needed for " +
                              std::to_string(structure.parameter_count()) + " parameters, and the data hold " +
                              std::to_string(data.sample_count()));
    for (const TransferChannel& channel : structure.channels)
        for (std::size_t e = 0; e < data.experiments.size(); ++e)
            if (channel.delay >= data.duration(e))
                throw InvalidArgument(method + ": the delay of " + number_text(channel.delay) +
                                      " s is not shorter than the record of " + number_text(data.duration(e)) + " s");
    for (Index input = 0; input < data.input_count(); ++input)
        if (in_all_experiments(data, [&](const Experiment& e) {
                return is_constant(e.u.col(input)) && !starts_from_rest(e.y.col(0)) && offset == Offset::kNone;
            }))
            throw InvalidArgument(method + ": " + numbered("input", input, data.input_count()) +
                                  " never changes and the output does not start from rest, so there is no excitation: "
                                  "let the input vary, for instance as a prbs");
    check_outputs(method, data);
}

void check_sampled_data(const std::string& method, const IdData& data) {
    if (data.input_count() > 0 && !data.regular())
        throw InvalidArgument(method + " needs regularly sampled data, and these are not: resample them first");
    check_signals(method, data);
}

void check_sample_count(const std::string& method, Index samples, Index values) {
    if (samples > values) return;
    throw InvalidArgument(method + " needs more samples than the " + counted(values, "value") +
                          " it estimates, and the record holds " + std::to_string(samples));
}

void check_transient(const std::string& method, const IdData& data, const Fit& fit, Index values) {
    if (fit.termination == Termination::kCancelled) return;
    for (const Experiment& experiment : data.experiments)
        for (Index input = 0; input < data.input_count(); ++input)
            if (!is_constant(experiment.u.col(input))) return;
    const Index outputs = data.output_count(), N = data.sample_count() * outputs;
    const auto experiments = outputs * static_cast<Index>(data.experiments.size());
    require_transient(method, {fit.loss, output_variations(data).sum() / static_cast<double>(N),
                               output_powers(data).mean(), N, values, experiments});
}

double shortest_record(const IdData& data) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < data.experiments.size(); ++e) shortest = std::min(shortest, data.duration(e));
    return shortest;
}

DelayRange delay_range(const IdData& data, const FitOptions& options) {
    const double shortest = shortest_record(data);
    const double largest = options.largest_delay.value_or(std::max(options.least_delay, shortest / 4));
    if (largest >= shortest)
        throw InvalidArgument("`largest_delay` must be shorter than the record of " + number_text(shortest) +
                              " s, and is " + number_text(largest) + " s");
    return {options.least_delay, largest};
}

namespace {

constexpr double kCancellation = 0.02;  // distance of a pole from a zero, relative to the pole

bool has_settled(const Fit& fit) {
    return fit.termination == Termination::kConverged || fit.termination == Termination::kNoProgress;
}

void warn_of_cancellation(Fit& fit) {
    for (const TransferFunction& G : fit.models) {
        const ComplexVector poles = G.poles(), zeros = G.zeros();
        for (const Complex& zero : zeros)
            for (const Complex& pole : poles)
                if (std::abs(zero - pole) < kCancellation * std::abs(pole)) {
                    fit.warnings.push_back("A pole near " + number_text(pole.real(), 3) +
                                           " and a zero nearly cancel: fewer poles and zeros may be enough.");
                    return;
                }
    }
}

void warn_of_instability(Fit& fit, const std::string& remedy) {
    for (std::size_t i = 0; i < fit.models.size(); ++i)
        if (has_unstable_pole(fit.models[i]))
            fit.warnings.push_back("The model" + channel_text(fit.structure, i) + " is unstable" +
                                   (remedy.empty() ? "" : ": unless the system is unstable, too, " + remedy) + ".");
}

/// A step of a held input reaches the output through the direct term at the next sampling instant, wherever between
/// two instants it arrives, and n + 1 weights of the sampled response cannot tell n + 1 coefficients and a delay.
void warn_of_ambiguous_delays(Fit& fit, const IdData& data) {
    if (!fit.structure.free_delays || data.hold != Hold::kZoh || !data.regular()) return;
    for (std::size_t i = 0; i < fit.models.size(); ++i)
        if (fit.models[i].zero_count() == fit.models[i].pole_count() && fit.models[i].delay() > 0)
            fit.warnings.push_back("The delay" + channel_text(fit.structure, i) +
                                   " is only known to within one sampling time, and its standard error means nothing: "
                                   "the input is held and the model has as many zeros as poles. Fix the delay with "
                                   "`delay`, or take one zero fewer.");
}

}  // namespace

void warn_of_search(Fit& fit, const FitOptions& options) {
    if (fit.termination == Termination::kIterationLimit)
        fit.warnings.push_back("The search had not settled after `max_iterations` = " +
                               std::to_string(options.max_iterations) + " iterations; the best point so far is given.");
    if (fit.termination == Termination::kCancelled)
        fit.warnings.push_back("The search was stopped before its end; the best point so far is given.");
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

void warn_of_doubtful_parameters(Fit& fit, const std::string& simpler) {
    if (!(fit.condition_number < kAmbiguousCondition)) {
        fit.warnings.push_back("The data do not determine all parameters separately (badly conditioned: " +
                               number_text(fit.condition_number, 2) + "): " + simpler +
                               " or a richer input is wanted.");
        return;
    }
    const std::string names = enumerated(undetermined_parameters(fit.names, fit.theta, fit.std));
    if (!names.empty())
        fit.warnings.push_back("The data hardly determine " + names + ": the standard error is larger than the value.");
}

void warn_of_delay(Fit& fit, double delay, const DelayRange& range, const std::string& channel) {
    const double edge = 1e-9 * range.largest;
    const std::string subject = "The delay" + channel + " lies at ", searched = " s, the edge of what was searched: ";
    if (delay >= range.largest - edge && range.largest > range.least)
        fit.warnings.push_back(subject + "`largest_delay` = " + number_text(range.largest) + searched +
                               "raise `largest_delay`.");
    else if (delay <= range.least + edge && range.least > 0)
        fit.warnings.push_back(subject + "`least_delay` = " + number_text(range.least) + searched +
                               "lower `least_delay`.");
    else if (delay <= edge && range.largest > 0 && std::ranges::none_of(fit.fit_percent, explains_little))
        fit.warnings.push_back("No delay" + channel + " is visible: a model without one suits.");
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

std::string channel_text(const TransferStructure& structure, std::size_t channel) {
    if (structure.single_channel()) return "";
    const std::size_t inputs = static_cast<std::size_t>(structure.inputs);
    return " from input " + std::to_string(channel % inputs + 1) + " to output " + std::to_string(channel / inputs + 1);
}

void describe_models(Fit& fit, const std::string& when_unstable) {
    fit.names = fit.structure.parameter_names();
    fit.models = fit.structure.models(fit.theta);
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    warn_of_cancellation(fit);
    warn_of_doubtful_parameters(fit);
    warn_of_instability(fit, when_unstable);
}

void describe_search(Fit& fit, const IdData& data, const std::string& method, const FitOptions& options,
                     const DelayRange& range) {
    warn_of_search(fit, options);
    describe_models(fit, options.stable ? "" : "`stable` = true finds the best stable one");
    for (std::size_t i = 0; i < fit.models.size() && fit.structure.free_delays && range.largest > range.least; ++i)
        warn_of_delay(fit, fit.models[i].delay(), range, channel_text(fit.structure, i));
    warn_of_ambiguous_delays(fit, data);
    set_message(fit, method + " " + ending_text(fit) + ", simulated " + message_text(description(fit.start)) + ": " +
                         simulation_text(fit) + ".");
}

std::string ending_text(const Fit& fit) {
    return (has_settled(fit) ? "converged after " : "stopped after ") + counted(fit.trace.size(), "iteration");
}

void set_message(Fit& fit, const std::string& first) {
    fit.message = first;
    for (const std::string& warning : fit.warnings) fit.message += " " + warning;
}

void add_warning(Fit& fit, const std::string& sentence) {
    fit.warnings.push_back(sentence);
    fit.message += " " + sentence;
}

std::string simulation_text(const Fit& fit) {
    std::string fits;
    for (Index output = 0; output < fit.fit_percent.size(); ++output)
        fits += (output == 0 ? "fit " : " % and ") + number_text(fit.fit_percent[output], 4);
    return fits + " % (simulation)";
}

}  // namespace dynlab::inline numerics
