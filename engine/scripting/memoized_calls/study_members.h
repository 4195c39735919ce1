#pragma once
#include <tuple>

#include "scripting/memoized_calls/class_members.h"
#include "scripting/objects/study_objects.h"

namespace dynlab::inline scripting {

/// Of studies; see class_members.h.

template <Is<TransferChannel> T>
auto members(T& object) {
    auto& [denominator, zeros, delay] = object;
    return std::tie(denominator, zeros, delay);
}

template <Is<TransferStructure> T>
auto members(T& object) {
    auto& [outputs, inputs, poles, channels, free_delays] = object;
    return std::tie(outputs, inputs, poles, channels, free_delays);
}

template <Is<StartCondition> T>
auto members(T& object) {
    auto& [state, offset] = object;
    return std::tie(state, offset);
}

template <Is<TransferIteration> T>
auto members(T& object) {
    auto& [theta, loss, change] = object;
    return std::tie(theta, loss, change);
}

template <Is<TransferEstimate> T>
auto members(T& object) {
    auto& [structure, theta, std, names, models, covariance, noise_variance, fit_percent, loss, condition_number, start,
           initial_values, offsets, delay_grid, delay_loss, termination, trace, warnings, message] = object;
    return std::tie(structure, theta, std, names, models, covariance, noise_variance, fit_percent, loss,
                    condition_number, start, initial_values, offsets, delay_grid, delay_loss, termination, trace,
                    warnings, message);
}

template <Is<OrderCandidate> T>
auto members(T& object) {
    auto& [poles, zeros, delay, failure, estimate, r_squared, yic, aic, bic, fpe, log_condition, iterations,
           fit_percent, validation_fit, evidence, undetermined, cancellation, converged] = object;
    return std::tie(poles, zeros, delay, failure, estimate, r_squared, yic, aic, bic, fpe, log_condition, iterations,
                    fit_percent, validation_fit, evidence, undetermined, cancellation, converged);
}

template <Is<OrderSelection> T>
auto members(T& object) {
    auto& [candidates, samples, validated, cancelled] = object;
    return std::tie(candidates, samples, validated, cancelled);
}

template <Is<OrderChoice> T>
auto members(T& object) {
    auto& [place, explanation] = object;
    return std::tie(place, explanation);
}

template <Is<OrderTable> T>
auto members(T& object) {
    auto& [selection, choice] = object;
    return std::tie(selection, choice);
}

template <Is<MonteCarloResult> T>
auto members(T& object) {
    auto& [label, names, theta, std, truth, mean, spread, median, low, high, reported, bias, bound, estimated, failed,
           not_converged, first_failure] = object;
    return std::tie(label, names, theta, std, truth, mean, spread, median, low, high, reported, bias, bound, estimated,
                    failed, not_converged, first_failure);
}

template <Is<MonteCarlo> T>
auto members(T& object) {
    auto& [results, sigma, snr, runs, cancelled] = object;
    return std::tie(results, sigma, snr, runs, cancelled);
}

}  // namespace dynlab::inline scripting
