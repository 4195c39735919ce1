#include "numerics/estimators/closed_loop/clsrivc.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/estimators/closed_loop/clivsvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/closed_loop/loop_equations.h"
#include "numerics/fit/closed_loop/loop_search.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/statistics/robust_covariance.h"

namespace dynlab::inline numerics {

namespace {

double largest_change(const Vector& now, const Vector& before) {
    return ((now - before).array() / now.array().abs().max(1e-12 * now.cwiseAbs().maxCoeff())).abs().maxCoeff();
}

/// theta where the passes begin.
Vector first_theta(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                   const LoopSignals& signals) {
    if (!options.lambda) return start_from_rest(with_projected_inputs(data, signals), structure, options);
    SvfOptions filter;
    filter.lambda = *options.lambda;
    filter.hold_y = options.hold_y;
    return clivsvf(data, structure, filter, {signals.controller(), false, signals.hold_r()}).theta;
}

Fit by_passes(const IdData& data, const TransferStructure& structure, const FitOptions& options,
              const LoopSignals& signals) {
    Fit estimate;
    estimate.structure = structure;
    estimate.theta = first_theta(data, structure, options, signals);
    estimate.termination = Termination::kIterationLimit;
    const DenominatorGroup group(data, structure, 0, options.hold_y);
    LoopEquations equations;
    bool in_loop = false;
    for (int pass = 0; pass < std::max(options.max_iterations, 1); ++pass) {
        if (options.cancel && options.cancel()) {
            estimate.termination = Termination::kCanceled;
            break;
        }
        const LoopSignals::All clean = signals.of_model(structure.models(estimate.theta).front());
        in_loop = clean.in_loop;
        equations = loop_equations(group, reflect_unstable_roots(group.denominator(estimate.theta)), clean);
        const Vector next = equations.solution(&estimate.condition_number);
        if (!next.allFinite())
            throw InvalidArgument(
                "clsrivc: the equations have no unique solution, because the reference does not excite the loop enough "
                "for {} parameters. Use a richer reference or fewer parameters",
                structure.parameter_count());
        const double change = largest_change(next, estimate.theta);
        estimate.theta = next;
        estimate.trace.push_back({next, 0, change});
        if (change > options.tolerance) continue;
        estimate.termination = Termination::kConverged;
        break;
    }
    estimate.covariance = equations.Z.size() > 0 ? equations.covariance(estimate.theta)
                                                 : Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    describe_loop(estimate, data, signals, in_loop);
    const Message passes = plural(static_cast<std::int64_t>(estimate.trace.size()), "{} pass", "{} passes");
    const bool settled = estimate.termination == Termination::kConverged;
    estimate.message = settled ? Message("CLSRIVC converged after {}, {}: {}.", passes,
                                         instruments_text(signals, in_loop), simulation_text(estimate))
                               : Message("CLSRIVC did not converge after {}, {}: {}.", passes,
                                         instruments_text(signals, in_loop), simulation_text(estimate));
    return estimate;
}

/// Of an estimate of least output error, with errors of any color.
Matrix output_covariance(const IdData& data, const TransferStructure& structure, const VectorView& theta) {
    const Index N = data.sample_count(), d = theta.size();
    const Vector A = structure.denominator(theta, 0, 0), B = structure.numerator(theta, 0, 0);
    Matrix psi(N, d);
    Vector errors(N);
    std::vector<Index> lengths;
    Index first = 0;
    for (const Experiment& experiment : data.experiments) {
        const Index count = experiment.y.rows();
        const Matrix answers = transfer_filters().sensitivities(B, A, structure.delay(theta, 0, 0), experiment.u.col(0),
                                                                {data.Ts, {nullptr, 0}}, data.hold);
        errors.segment(first, count) = experiment.y.col(0) - answers.col(0);
        psi.middleRows(first, count) = answers.middleCols(1, d);
        lengths.push_back(count);
        first += count;
    }
    return robust_covariance(psi, errors, lengths).covariance;
}

Fit two_stage(const IdData& data, const TransferStructure& structure, const FitOptions& options,
              const LoopSignals& signals) {
    const IdData projected = with_projected_inputs(data, signals);
    Fit estimate = srivc(projected, structure, options);
    estimate.covariance = output_covariance(projected, structure, estimate.theta);
    estimate.warnings = {
        Message("The standard errors neglect the uncertainty of the projected input. They can be several times too "
                "large or 25 % too small.")};
    measure_simulation(estimate, data);
    describe_models(estimate);
    estimate.message =
        has_settled(estimate)
            ? Message("SRIVC with the input projected onto the reference (two-stage route) converged after {}: {}.",
                      iteration_count(estimate), simulation_text(estimate))
            : Message("SRIVC with the input projected onto the reference (two-stage route) stopped after {}: {}.",
                      iteration_count(estimate), simulation_text(estimate));
    return estimate;
}

Fit direct(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    Fit estimate = srivc(data, structure, options);
    estimate.covariance = output_covariance(data, structure, estimate.theta);
    estimate.warnings.clear();
    describe_models(estimate);
    estimate.warnings.push_back(
        Message("The direct route ignores the controller: feedback correlates the input with the noise, which biases "
                "the estimate unless the noise is white."));
    return estimate;
}

}  // namespace

Fit clsrivc(const IdData& data, const TransferStructure& structure, const FitOptions& options,
            const LoopKnowledge& known, LoopRoute route) {
    options.validate();
    const FitOptions own = options.from_rest();
    check_loop_data("clsrivc", data, structure);
    if (route == LoopRoute::kDirect) return direct(data, structure, own);
    if (route == LoopRoute::kIndirect && !known.controller)
        throw InvalidArgument(
            "clsrivc: the indirect route needs a known controller; specify the controller, or choose another route");
    const LoopSignals signals("clsrivc", data, known);
    if (route == LoopRoute::kTwoStage) return two_stage(data, structure, own, signals);
    Fit estimate = by_passes(data, structure, own, signals);
    if (route == LoopRoute::kAuxiliary || estimate.termination == Termination::kCanceled) return estimate;
    return search_loop(std::move(estimate), data, own, signals);
}

}  // namespace dynlab::inline numerics
