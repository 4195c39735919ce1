#include "numerics/fit/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "numerics/number_text.h"

namespace dynlab::inline numerics {

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

void warn_of_instability(Fit& fit) {
    for (std::size_t i = 0; i < fit.models.size(); ++i) {
        const ComplexVector poles = fit.models[i].poles();
        if ((poles.real().array() > 1e-9 * poles.cwiseAbs().maxCoeff()).any())
            fit.warnings.push_back("The model" + channel_text(fit.structure, i) + " is unstable.");
    }
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

void warn_of_doubtful_parameters(Fit& fit, const std::string& simpler) {
    if (!(fit.condition_number < kAmbiguousCondition)) {
        fit.warnings.push_back("The data do not determine all parameters separately (badly conditioned: " +
                               number_text(fit.condition_number, 2) + "): " + simpler +
                               " or a richer input is wanted.");
        return;
    }
    std::string names;
    for (Index i = 0; i < fit.theta.size(); ++i) {
        const std::string& name = fit.names[static_cast<std::size_t>(i)];
        if (fit.std[i] > std::abs(fit.theta[i]) && !name.starts_with("Td")) names += (names.empty() ? "" : ", ") + name;
    }
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
    else if (delay <= edge && range.largest > 0)
        fit.warnings.push_back("No delay" + channel + " is visible: a model without one suits.");
}

void warn_of_unstable_polynomials(Fit& fit) {
    for (std::size_t input = 0; input < fit.orders.inputs(); ++input)
        if (!fit.polynomial->transfer_function(input).stable()) {
            fit.warnings.push_back("The model has a pole outside or on the unit circle.");
            return;
        }
}

std::string channel_text(const TransferStructure& structure, std::size_t channel) {
    if (structure.single_channel()) return "";
    const std::size_t inputs = static_cast<std::size_t>(structure.inputs);
    return " from input " + std::to_string(channel % inputs + 1) + " to output " + std::to_string(channel / inputs + 1);
}

void describe_models(Fit& fit) {
    fit.names = fit.structure.parameter_names();
    fit.models = fit.structure.models(fit.theta);
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    warn_of_cancellation(fit);
    warn_of_doubtful_parameters(fit);
    warn_of_instability(fit);
}

void describe_search(Fit& fit, const IdData& data, const std::string& method, const FitOptions& options,
                     const DelayRange& range) {
    warn_of_search(fit, options);
    describe_models(fit);
    for (std::size_t i = 0; i < fit.models.size() && fit.structure.free_delays && range.largest > range.least; ++i)
        warn_of_delay(fit, fit.models[i].delay(), range, channel_text(fit.structure, i));
    warn_of_ambiguous_delays(fit, data);
    set_message(fit, method + " " + ending_text(fit) + ", simulated " + description(fit.start) + ": " +
                         simulation_text(fit) + ".");
}

std::string ending_text(const Fit& fit) {
    return (has_settled(fit) ? "converged after " : "stopped after ") + iterations_text(fit.trace.size());
}

void set_message(Fit& fit, const std::string& first) {
    fit.message = first;
    for (const std::string& warning : fit.warnings) fit.message += " " + warning;
}

std::string simulation_text(const Fit& fit) {
    std::string fits;
    for (Index output = 0; output < fit.fit_percent.size(); ++output)
        fits += (output == 0 ? "fit " : " % and ") + number_text(fit.fit_percent[output], 4);
    return fits + " % (simulation)";
}

}  // namespace dynlab::inline numerics
