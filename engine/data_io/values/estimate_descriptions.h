#pragma once
#include "data_io/values/model_descriptions.h"
#include "numerics/estimators/step_test.h"
#include "numerics/fit/fit.h"
#include "numerics/validation/assessment.h"
#include "numerics/validation/monte_carlo.h"
#include "numerics/validation/order_selection.h"

namespace dynlab::inline data_io {

/// Results of estimations and studies as described.h stores them.

constexpr std::array<const char*, 5> names_of(Termination) {
    return {"converged", "iteration_limit", "no_progress", "diverged", "cancelled"};
}

constexpr std::array<const char*, 4> names_of(InitialState) {
    return {"zero", "steady", "estimate", "auto"};
}

template <Is<Level> T, class V>
void describe(T& object, V& member) {
    auto& [value, from, to] = object;
    member("value", value), member("from", from), member("to", to);
}

template <Is<StepRecord> T, class V>
void describe(T& object, V& member) {
    auto& [t, u, y, step_index, step_time, input_before, input_after, initial, final, noise_std, smoothed] = object;
    member("t", t), member("u", u), member("y", y), member("step_index", step_index), member("step_time", step_time);
    member("input_before", input_before), member("input_after", input_after);
    member("initial", initial), member("final", final), member("noise_std", noise_std), member("smoothed", smoothed);
}

template <Is<ReadingPoint> T, class V>
void describe(T& object, V& member) {
    auto& [name, time, value] = object;
    member("name", name), member("time", time), member("value", value);
}

template <Is<StepTestResult> T, class V>
void describe(T& object, V& member) {
    auto& [model, names, parameters, record, points, message] = object;
    member("model", model), member("names", names), member("parameters", parameters);
    member("record", record), member("points", points), member("message", message);
}

template <Is<WhitenessTest> T, class V>
void describe(T& object, V& member) {
    auto& [correlation, bound, statistic, degrees, outside, p_value, white, verdict] = object;
    member("correlation", correlation), member("bound", bound), member("statistic", statistic);
    member("degrees", degrees), member("outside", outside), member("p_value", p_value);
    member("white", white), member("verdict", verdict);
}

template <Is<Assessment> T, class V>
void describe(T& object, V& member) {
    auto& [whiteness, white, covariance, std, bandwidth, verdict] = object;
    member("whiteness", whiteness), member("white", white), member("covariance", covariance);
    member("std", std), member("bandwidth", bandwidth), member("verdict", verdict);
}

template <Is<TransferChannel> T, class V>
void describe(T& object, V& member) {
    auto& [denominator, zeros, delay] = object;
    member("denominator", denominator), member("zeros", zeros), member("delay", delay);
}

template <Is<TransferStructure> T, class V>
void describe(T& object, V& member) {
    auto& [outputs, inputs, poles, channels, free_delays] = object;
    member("outputs", outputs), member("inputs", inputs), member("poles", poles), member("channels", channels);
    member("free_delays", free_delays);
}

template <Is<StartCondition> T, class V>
void describe(T& object, V& member) {
    auto& [state, offset] = object;
    member("state", state), member("offset", offset);
}

template <Is<FitIteration> T, class V>
void describe(T& object, V& member) {
    auto& [theta, loss, change] = object;
    member("theta", theta), member("loss", loss), member("change", change);
}

/// Of transfer functions: studies keep no other fits.
template <Is<Fit> T, class V>
void describe(T& object, V& member) {
    auto& [structure, models, process, orders, polynomial, characteristic, noise, names, theta, std, covariance,
           noise_covariance, noise_variance, fit_percent, prediction_fit_percent, loss, condition_number, at_bound,
           start, initial_values, offsets, removed, output, delay_grid, delay_loss, termination, trace, warnings,
           message] = object;
    member("structure", structure), member("theta", theta), member("std", std), member("names", names);
    member("models", models), member("covariance", covariance), member("noise_variance", noise_variance);
    member("fit_percent", fit_percent), member("loss", loss), member("condition_number", condition_number);
    member("start", start), member("initial_values", initial_values), member("offsets", offsets);
    member("delay_grid", delay_grid), member("delay_loss", delay_loss), member("termination", termination);
    member("trace", trace), member("warnings", warnings), member("message", message);
}

template <Is<OrderCandidate> T, class V>
void describe(T& object, V& member) {
    auto& [poles, zeros, delay, failure, estimate, r_squared, yic, aic, bic, fpe, log_condition, iterations,
           fit_percent, validation_fit, evidence, undetermined, cancellation, converged] = object;
    member("poles", poles), member("zeros", zeros), member("delay", delay), member("failure", failure);
    member("estimate", estimate), member("r_squared", r_squared), member("yic", yic), member("aic", aic);
    member("bic", bic), member("fpe", fpe), member("log_condition", log_condition), member("iterations", iterations);
    member("fit_percent", fit_percent), member("validation_fit", validation_fit), member("evidence", evidence);
    member("undetermined", undetermined), member("cancellation", cancellation), member("converged", converged);
}

template <Is<OrderSelection> T, class V>
void describe(T& object, V& member) {
    auto& [candidates, samples, validated, cancelled] = object;
    member("candidates", candidates), member("samples", samples);
    member("validated", validated), member("cancelled", cancelled);
}

template <Is<OrderChoice> T, class V>
void describe(T& object, V& member) {
    auto& [place, explanation] = object;
    member("place", place), member("explanation", explanation);
}

template <Is<MonteCarloResult> T, class V>
void describe(T& object, V& member) {
    auto& [label, names, theta, std, truth, mean, spread, median, low, high, reported, bias, bound, estimated, failed,
           not_converged, first_failure] = object;
    member("label", label), member("names", names), member("theta", theta), member("std", std), member("truth", truth);
    member("mean", mean), member("spread", spread), member("median", median), member("low", low), member("high", high);
    member("reported", reported), member("bias", bias), member("bound", bound), member("estimated", estimated);
    member("failed", failed), member("not_converged", not_converged), member("first_failure", first_failure);
}

template <Is<MonteCarlo> T, class V>
void describe(T& object, V& member) {
    auto& [results, sigma, snr, runs, cancelled] = object;
    member("results", results), member("sigma", sigma), member("snr", snr), member("runs", runs);
    member("cancelled", cancelled);
}

}  // namespace dynlab::inline data_io
