#pragma once
#include "data_io/values/estimate_descriptions.h"
#include "scripting/objects/model.h"
#include "scripting/objects/study_objects.h"

namespace dynlab::inline scripting {

/// Objects of scripts as data_io/values/described.h stores them. Answers hold of an estimate what checks look at; what
/// only plots and `present` use is kept for programs.

DYNLAB_DESCRIBE(ParameterErrors, std, covariance)
DYNLAB_DESCRIBE(NoiseModel, C, D, C_std, D_std, Ts)
DYNLAB_DESCRIBE(ParameterHistory, t, theta, std)

template <Is<ReportFields> T, class V>
void describe(T& object, V& member) {
    auto& [numbers, vectors, matrices, simulated] = object;
    member("numbers", numbers), member.kept("vectors", vectors), member.kept("matrices", matrices);
    member.kept("simulated", simulated);
}

template <Is<Estimate> T, class V>
void describe(T& object, V& member) {
    auto& [method, names, theta, errors, message, warnings, fields, converged, of_coefficients, carx, step_test,
           diagnostics, noise, history] = object;
    member("method", method), member("names", names), member("theta", theta), member("errors", errors);
    member("message", message), member("warnings", warnings);
    member("fields", fields);
    member("converged", converged), member("of_coefficients", of_coefficients), member("carx", carx);
    member.kept("step_test", step_test), member.kept("diagnostics", diagnostics), member.kept("noise", noise);
    member.kept("history", history);
}
void check_value(const Estimate& estimate, const ValueLimits& limits);

template <Is<Model> T, class V>
void describe(T& object, V& member) {
    auto& [G, process, estimate, polynomial, channels, outputs, system] = object;
    member("function", G), member("process", process), member("estimate", estimate), member("polynomial", polynomial);
    member("channels", channels), member("outputs", outputs), member("system", system);
}
void check_value(const Model& model, const ValueLimits& limits);

DYNLAB_DESCRIBE(OrderTable, selection, choice)

}  // namespace dynlab::inline scripting
