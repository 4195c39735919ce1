#pragma once
#include <tuple>

#include "numerics/signals/iddata.h"
#include "scripting/memoized_calls/class_members.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// Of models and data; see class_members.h.

/// Read by its constructor, which leaves what another one made as it is.
inline auto members(const TransferFunction& x) {
    return std::tuple<const Vector&, const Vector&, double, double>(x.num(), x.den(), x.Ts(), x.delay());
}

template <Is<Experiment> T>
auto members(T& object) {
    auto& [y, u, t, start_time, name] = object;
    return std::tie(y, u, t, start_time, name);
}

template <Is<IdData> T>
auto members(T& object) {
    auto& [experiments, Ts, hold, input_names, output_names, input_units, output_units, time_unit] = object;
    return std::tie(experiments, Ts, hold, input_names, output_names, input_units, output_units, time_unit);
}

template <Is<ProcessStructure> T>
auto members(T& object) {
    auto& [poles, underdamped, delay, integrator, zero] = object;
    return std::tie(poles, underdamped, delay, integrator, zero);
}

template <Is<ProcessModel> T>
auto members(T& object) {
    auto& [structure, parameters] = object;
    return std::tie(structure, parameters);
}

template <Is<PolynomialModel> T>
auto members(T& object) {
    auto& [A, C, D, B, F, Ts] = object;
    return std::tie(A, C, D, B, F, Ts);
}

template <Is<StateSpace> T>
auto members(T& object) {
    auto& [A, B, C, D, Ts] = object;
    return std::tie(A, B, C, D, Ts);
}

template <Is<Level> T>
auto members(T& object) {
    auto& [value, from, to] = object;
    return std::tie(value, from, to);
}

template <Is<StepRecord> T>
auto members(T& object) {
    auto& [t, u, y, step_index, step_time, input_before, input_after, initial, final, noise_std, smoothed] = object;
    return std::tie(t, u, y, step_index, step_time, input_before, input_after, initial, final, noise_std, smoothed);
}

template <Is<ReadingPoint> T>
auto members(T& object) {
    auto& [name, time, value] = object;
    return std::tie(name, time, value);
}

template <Is<StepTestResult> T>
auto members(T& object) {
    auto& [model, names, parameters, record, points, message] = object;
    return std::tie(model, names, parameters, record, points, message);
}

template <Is<WhitenessTest> T>
auto members(T& object) {
    auto& [correlation, bound, statistic, degrees, outside, p_value, white, verdict] = object;
    return std::tie(correlation, bound, statistic, degrees, outside, p_value, white, verdict);
}

template <Is<Assessment> T>
auto members(T& object) {
    auto& [whiteness, white, covariance, std, bandwidth, verdict] = object;
    return std::tie(whiteness, white, covariance, std, bandwidth, verdict);
}

template <Is<NoiseModel> T>
auto members(T& object) {
    auto& [C, D, C_std, D_std] = object;
    return std::tie(C, D, C_std, D_std);
}

template <Is<Estimate> T>
auto members(T& object) {
    auto& [method, names, theta, std, covariance, message, warnings, numbers, vectors, matrices, converged,
           of_coefficients, carx, step_test, assessment, noise] = object;
    return std::tie(method, names, theta, std, covariance, message, warnings, numbers, vectors, matrices, converged,
                    of_coefficients, carx, step_test, assessment, noise);
}

template <Is<Model> T>
auto members(T& object) {
    auto& [G, process, estimate, polynomial, channels, outputs, system] = object;
    return std::tie(G, process, estimate, polynomial, channels, outputs, system);
}

/// A value to be filled; classes that cannot be empty have the smallest that there is.
template <class T>
T blank() {
    return T{};
}
template <>
inline ProcessModel blank() {
    return {ProcessStructure{}, Vector::Zero(2)};
}
template <>
inline PolynomialModel blank() {
    return {PolynomialOrders::arx(1, {1}, {1}), Vector::Zero(2), 1};
}

}  // namespace dynlab::inline scripting
