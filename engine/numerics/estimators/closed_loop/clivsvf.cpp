#include "numerics/estimators/closed_loop/clivsvf.h"

#include "numerics/error.h"
#include "numerics/fit/closed_loop/loop_equations.h"
#include "numerics/fit/closed_loop/loop_search.h"
#include "numerics/fit/diagnosis.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kLoopPasses = 3;

}  // namespace

Fit clivsvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options,
            const LoopKnowledge& known) {
    options.validate();
    check_loop_data("clivsvf", data, structure);
    const LoopSignals signals("clivsvf", data, known);
    const DenominatorGroup group(data, structure, 0, options.hold_y);
    const Vector E = filter_denominator(options.lambda, group.order());
    Fit estimate;
    estimate.structure = structure;
    estimate.theta = solve_equations(group.svf(E));
    bool in_loop = false;
    LoopEquations equations;
    for (int pass = 0; pass < kLoopPasses && estimate.theta.allFinite(); ++pass) {
        const LoopSignals::All clean = signals.of_model(structure.models(estimate.theta).front());
        in_loop = clean.in_loop;
        equations = loop_equations(group, E, clean);
        estimate.theta = equations.solution(&estimate.condition_number);
    }
    if (!estimate.theta.allFinite())
        throw InvalidArgument(
            "clivsvf: the equations have no unique solution, because the reference does not excite the loop enough for "
            "{} parameters. Use a richer reference or fewer parameters",
            structure.parameter_count());
    estimate.covariance = equations.covariance(estimate.theta);
    estimate.termination = Termination::kConverged;
    describe_loop(estimate, data, signals, in_loop);
    warn_of_cutoff(estimate, options.lambda);
    estimate.message = Message("Instrumental variables on filtered signals, {}.", instruments_text(signals, in_loop));
    return estimate;
}

}  // namespace dynlab::inline numerics
