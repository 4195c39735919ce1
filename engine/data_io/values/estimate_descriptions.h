#pragma once
#include "data_io/values/model_descriptions.h"
#include "numerics/estimators/step_test.h"
#include "numerics/fit/diagnostics.h"
#include "numerics/validation/monte_carlo.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline data_io {

/// Results of estimations and studies as described.h stores them.

constexpr std::array<const char*, 5> names_of(Termination) {
    return {"converged", "iteration_limit", "no_progress", "diverged", "canceled"};
}

constexpr std::array<const char*, 4> names_of(InitialState) {
    return {"zero", "steady", "estimate", "auto"};
}

constexpr std::array<const char*, 6> names_of(StructureAdviceCode) {
    return {"delay", "pole", "feedthrough", "hold", "late", "line"};
}

DYNLAB_DESCRIBE(Level, value, from, to)
DYNLAB_DESCRIBE(StepData, t, u, y, step_index, step_time, input_before, input_after, initial, final, noise_std,
                smoothed)
DYNLAB_DESCRIBE(ReadingPoint, name, time, value)
template <Is<StepTestResult> T, class V>
void describe(T& object, V& member) {
    auto& [model, names, parameters, step_data, points, message] = object;
    member("model", model), member("names", names), member("parameters", parameters);
    member("record", step_data), member("points", points), member("message", message);
}
DYNLAB_DESCRIBE(WhitenessTest, correlation, bound, statistic, degrees, outside, p_value, white, verdict)
DYNLAB_DESCRIBE(Assessment, whiteness, white, covariance, std, bandwidth, verdict)
DYNLAB_DESCRIBE(TransferChannel, denominator, zeros, delay)
DYNLAB_DESCRIBE(TransferStructure, outputs, inputs, poles, channels, free_delays)
DYNLAB_DESCRIBE(StartCondition, state, offset)
DYNLAB_DESCRIBE(FitIteration, theta, loss, change)
DYNLAB_DESCRIBE(StructureAdvice, code, option, value, output, samples, fit_percent, better_fit_percent)
DYNLAB_DESCRIBE(Diagnostics, missed, assessment)

/// Computed when it is written, which is for programs only.
template <class T>
struct StoredAs<Deferred<T>> {
    using Form = T;
    static T form(const Deferred<T>& deferred) { return deferred.get(); }
    static Deferred<T> value(T&& known) { return std::move(known); }
};
template <>
struct StoredAs<DeferredDiagnostics> {
    using Form = Diagnostics;
    static Diagnostics form(const DeferredDiagnostics& diagnostics) { return diagnostics.all(); }
    static DeferredDiagnostics value(Diagnostics&& known) { return DeferredDiagnostics(std::move(known)); }
};

/// Of transfer functions: studies keep no other fits.
template <Is<Fit> T, class V>
void describe(T& object, V& member) {
    auto& [structure, models, process, orders, polynomial, characteristic, noise, history, names, theta, std,
           covariance, noise_covariance, noise_variance, output_weights, fit_percent, prediction_fit_percent, loss,
           condition_number, at_bound, start, initial_values, offsets, removed, output, delay_grid, delay_loss,
           termination, trace, warnings, message] = object;
    member("structure", structure), member("theta", theta), member("std", std), member("names", names);
    member("models", models), member("covariance", covariance), member("noise_variance", noise_variance);
    member("output_weights", output_weights);
    member("fit_percent", fit_percent), member("loss", loss), member("condition_number", condition_number);
    member("start", start), member("initial_values", initial_values), member("offsets", offsets);
    member("delay_grid", delay_grid), member("delay_loss", delay_loss), member("termination", termination);
    member("trace", trace), member("warnings", warnings), member("message", message);
}

DYNLAB_DESCRIBE(OrderCandidate, poles, zeros, delay, failure, estimate, r_squared, yic, aic, bic, fpe, log_condition,
                iterations, fit_percent, validation_fit, evidence, undetermined, cancellation, converged, integrator,
                unstable)
DYNLAB_DESCRIBE(OrderSelection, candidates, samples, validated, canceled)
DYNLAB_DESCRIBE(OrderChoice, place, explanation)
DYNLAB_DESCRIBE(MonteCarloEstimate, theta, std, names, continuous, converged)
DYNLAB_DESCRIBE(MonteCarloOutcome, estimate, failure, done)
DYNLAB_DESCRIBE(MonteCarloRun, outcomes)
DYNLAB_DESCRIBE(MonteCarloResult, label, names, theta, std, truth, mean, spread, median, low, high, reported, bias,
                bound, estimated, failed, not_converged, first_failure)
DYNLAB_DESCRIBE(MonteCarlo, results, sigma, snr, runs, canceled)

}  // namespace dynlab::inline data_io
