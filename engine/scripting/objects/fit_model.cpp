#include "scripting/objects/fit_model.h"

#include <algorithm>

#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

Vector initial_values_of(const Fit& fit) {
    return fit.initial_values.empty() ? Vector() : fit.initial_values.front();
}

void add_transfer_fields(ReportFields& fields, const Fit& fit) {
    const auto passes = static_cast<Index>(fit.trace.size());
    Vector changes(passes);
    Matrix path(passes, fit.theta.size());
    for (Index i = 0; i < passes; ++i) {
        const FitIteration& iteration = fit.trace[static_cast<std::size_t>(i)];
        changes[i] = iteration.change;
        path.row(i) = iteration.theta.transpose();
    }
    fields.vectors = {{"fits", fit.fit_percent},       {"delay_grid", fit.delay_grid},
                      {"delay_loss", fit.delay_loss},  {"initial_values", initial_values_of(fit)},
                      {"offsets", fit.offsets.col(0)}, {"changes", changes}};
    fields.matrices = {{"path", path}};
}

void add_noise_fields(ReportFields& fields, const Fit& fit) {
    fields.numbers.emplace_back("Ts", fit.noise->Ts);
    fields.vectors.insert(fields.vectors.end(), {{"C_std", fit.noise->C_std}, {"D_std", fit.noise->D_std}});
    fields.matrices.emplace_back("noise_covariance", fit.noise_covariance);
}

void add_process_fields(ReportFields& fields, const Fit& fit) {
    fields.numbers.emplace_back("offset", fit.offsets(0, 0));
    fields.vectors = {{"output", fit.output},
                      {"initial_values", initial_values_of(fit)},
                      {"offsets", fit.offsets.col(0)},
                      {"delay_grid", fit.delay_grid},
                      {"delay_loss", fit.delay_loss}};
}

void add_polynomial_fields(ReportFields& fields, const Fit& fit) {
    fields.numbers.emplace_back("prediction_fit_percent", fit.prediction_fit_percent);
    Vector losses(static_cast<Index>(fit.trace.size()));
    for (Index i = 0; i < losses.size(); ++i) losses[i] = fit.trace[static_cast<std::size_t>(i)].loss;
    fields.vectors = {{"offsets", fit.offsets.col(0)}, {"losses", losses}};
}

void add_characteristic_fields(ReportFields& fields, const StaticCharacteristic& characteristic) {
    fields.numbers.emplace_back("linear_fit_percent", characteristic.linear_fit_percent);
    fields.vectors = {{"breakpoints", characteristic.breakpoints},
                      {"levels", characteristic.levels},
                      {"levels_std", characteristic.levels_std}};
}

/// Whether theta and covariance are those of the coefficients of the model: not behind a characteristic, nor next to
/// an integrator.
bool is_of_coefficients(const Fit& fit) {
    if (fit.characteristic) return false;
    if (fit.process || fit.structure.channels.empty()) return true;
    const Index own = fit.structure.poles[static_cast<std::size_t>(fit.structure.channels.front().denominator)];
    return fit.models.front().pole_count() == own;
}

void push_fitted(const Call& call, Estimate estimate, const Fit& fit, int user_values) {
    Model model{fit.polynomial ? fit.polynomial->transfer_function() : fit.models.front()};
    if (fit.models.size() > 1) {
        model.channels = fit.models;
        model.outputs = static_cast<std::size_t>(fit.structure.outputs);
    }
    if (fit.process) model.process = *fit.process;
    if (fit.polynomial) model.polynomial = std::make_shared<PolynomialModel>(*fit.polynomial);
    model.estimate = std::make_shared<Estimate>(std::move(estimate));
    push_object(call.state(), std::move(model), user_values);
}

ReportFields basic_fields(const Fit& fit) {
    return {{{"fit_percent", fit.fit_percent[0]}, {"loss", fit.loss}, {"condition_number", fit.condition_number}},
            {{"fits", fit.fit_percent}}};
}

/// Whether nothing is assumed or estimated of the past, as in arx, iv4 and armax.
bool continues_measured_values(const Fit& fit) {
    return fit.orders && fit.start.state == InitialState::kEstimate && !fit.start.offset &&
           std::ranges::all_of(fit.orders->nf, [](int order) { return order == 0; });
}

/// From which state the fit was simulated, and the offset of each output (experiment by experiment) in it.
Message simulation_of(const Fit& fit) {
    constexpr Index kMaxShown = 6;
    if (!fit.removed.empty() || fit.start.offset) {
        MessageList offsets;
        for (const double offset : fit.offsets.transpose().reshaped())
            offsets.items.push_back(Message("{}", significant(offset, 4)));
        const bool few = fit.offsets.size() <= kMaxShown;
        if (!fit.removed.empty())
            return few ? Message("The operating point was removed from the data; the offset of the output is {}.",
                                 offsets)
                       : Message("The operating point was removed from the data.");
        if (few) return Message("The fit refers to the simulation {} ({}).", description(fit.start), offsets);
    }
    if (continues_measured_values(fit))
        return Message("The fit refers to the simulation from the measured past values, without an offset.");
    return fit.start.offset
               ? Message("The fit refers to the simulation {}.", description(fit.start))
               : Message("The fit refers to the simulation {}, without an offset.", description(fit.start));
}

ReportFields report_fields(const Fit& fit) {
    ReportFields fields = basic_fields(fit);
    fields.simulated = simulation_of(fit);
    fields.vectors.clear();  // those of each kind of fit
    fields.numbers.insert(fields.numbers.end(), {{"noise_variance", fit.noise_variance[0]},
                                                 {"iterations", static_cast<double>(fit.trace.size())}});
    if (!fit.structure.channels.empty()) add_transfer_fields(fields, fit);
    if (fit.noise) add_noise_fields(fields, fit);
    if (fit.process) add_process_fields(fields, fit);
    if (fit.polynomial) add_polynomial_fields(fields, fit);
    if (fit.characteristic) add_characteristic_fields(fields, *fit.characteristic);
    return fields;
}

ParameterErrors errors_of(const Fit& fit) {
    return {fit.std, fit.covariance};
}

/// All but errors and what the report says by name.
Estimate named_estimate(const char* method, const Fit& fit) {
    Estimate estimate;
    estimate.method = method;
    estimate.names = fit.names;
    estimate.theta = fit.theta;
    estimate.message = fit.full_message();
    estimate.warnings = fit.warnings;
    estimate.converged = fit.termination == Termination::kConverged;
    return estimate;
}

/// Adds the fields that depend on the kind of fit.
void add_kind(Estimate& estimate, const Fit& fit, FitForm form) {
    estimate.carx = form == FitForm::kEquationError;
    estimate.of_coefficients = is_of_coefficients(fit);
    estimate.history = fit.history;
    if (fit.noise) estimate.noise = std::make_shared<NoiseModel>(*fit.noise);
}

}  // namespace

Estimate basic_estimate(const char* method, const Fit& fit) {
    Estimate estimate = named_estimate(method, fit);
    estimate.errors = errors_of(fit);
    estimate.fields = basic_fields(fit);
    return estimate;
}

void push_report(const Call& call, const Estimate& estimate) {
    give_table(call, "method", estimate.method, "message", localized(call, estimate.full_message()), "converged",
               estimate.converged);
    const ReportFields& fields = estimate.report();
    for (const auto& [name, value] : fields.numbers) set_field(call, name.c_str(), value);
    for (const auto& [name, values] : fields.vectors) set_field(call, name.c_str(), values);
    for (const auto& [name, values] : fields.matrices) set_field(call, name.c_str(), values);
    if (const auto assessment = estimate.diagnostics.assessment())
        set_field(call, "white", assessment->white, "residual_verdict", localized(call, assessment->verdict));
    set_field(call, "warnings", localized(call, estimate.all_warnings()));
}

Estimate estimate_of(const char* method, const Fit& fit, FitForm form) {
    Estimate estimate = named_estimate(method, fit);
    estimate.errors = errors_of(fit);
    add_kind(estimate, fit, form);
    estimate.fields = report_fields(fit);
    return estimate;
}

Estimate deferred_estimate(const char* method, const Fit& fit, FitForm form, std::function<Fit()> measured,
                           std::function<Fit()> with_errors) {
    Estimate estimate = named_estimate(method, fit);
    add_kind(estimate, fit, form);
    estimate.fields =
        Deferred<ReportFields>::later([measured = std::move(measured)] { return report_fields(measured()); });
    estimate.errors =
        Deferred<ParameterErrors>::later([with_errors = std::move(with_errors)] { return errors_of(with_errors()); });
    return estimate;
}

int give_fit(const Call& call, const char* method, const Fit& fit, FitForm form) {
    return give_estimate(call, estimate_of(method, fit, form), fit);
}

int give_diagnosed_fit(const Call& call, const char* method, const Fit& fit, const FitOptions& options) {
    Estimate estimate = estimate_of(method, fit);
    estimate.diagnostics = DeferredDiagnostics(fit, shared_object<IdData>(call.state(), 1), options);
    return give_deferring(call, std::move(estimate), fit);
}

int give_deferring(const Call& call, Estimate estimate, const Fit& fit) {
    push_fitted(call, std::move(estimate), fit, 1);
    lua_pushvalue(call.state(), 1);  // the data are charged to Lua's memory as long as the model refers to them
    lua_setiuservalue(call.state(), -2, 1);
    return 1;
}

int give_estimate(const Call& call, Estimate estimate, const Fit& fit) {
    push_fitted(call, std::move(estimate), fit, 0);
    return 1;
}

int give_system(const Call& call, Estimate estimate, const Fit& fit, const StateSpace& system) {
    Model model{fit.models.front()};
    if (fit.models.size() > 1) model.channels = fit.models;
    model.outputs = static_cast<std::size_t>(system.C.rows());
    model.estimate = std::make_shared<Estimate>(std::move(estimate));
    model.system = std::make_shared<StateSpace>(system);
    push_object(call.state(), std::move(model));
    return 1;
}

}  // namespace dynlab::inline scripting
