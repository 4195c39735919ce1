#include "numerics/estimators/srivc.h"

#include <algorithm>

#include "numerics/fit/diagnosis.h"
#include "numerics/fit/doubts.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/simulation_error.h"
#include "numerics/fit/srivc_iteration.h"
#include "numerics/fit/srivc_search.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kReweightings = 3;
constexpr double kGramTolerance = 1e-6;  // relative change of theta; standard errors change by some 20 times as much

/// (sum Z'Z/noise variance)^-1 of each denominator group; `last_gram` is sum Z'Z of the last pass, or empty.
void set_covariance(Fit& estimate, const IdData& data, const FitOptions& options, const Matrix& last_gram) {
    const TransferStructure& structure = estimate.structure;
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        DenominatorGroup group(data, structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count(), place = group.place();
        const double largest = estimate.noise_variance.maxCoeff();  // keeps the weights finite without noise
        for (const Index output : group.outputs())
            group.set_weight(output, largest > 0 ? largest / estimate.noise_variance[output] : 1);
        double condition = 0;
        const Matrix gram = last_gram.size() > 0 ? Matrix(last_gram.block(place, place, d, d))
                                                 : group.sensitivity_gram(estimate.theta.segment(place, d));
        estimate.covariance.block(place, place, d, d) = largest * inverse_gram(gram, &condition);
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
}

/// The passes; where outputs share a denominator, more of them with each output weighted by its noise.
SrivcSolution solve(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    SrivcExtras extras;
    extras.with_gram = structure.outputs == 1 && options.tolerance <= kGramTolerance;
    const Vector start = start_from_rest(data, structure, options, CutoffTrials::kValleys);
    SrivcSolution solution = iterate_srivc(data, structure, start, options, extras);
    for (int i = 0; structure.outputs_share_denominator() && i < kReweightings; ++i) {
        extras.weights.resize(structure.outputs);
        for (Index output = 0; output < structure.outputs; ++output)
            extras.weights[output] = 1 / simulation_squares(data, structure, solution.theta, output);
        if (!extras.weights.allFinite()) break;
        extras.weights /= extras.weights.maxCoeff();
        SrivcSolution next = iterate_srivc(data, structure, solution.theta, options, extras);
        next.trace.insert(next.trace.begin(), solution.trace.begin(), solution.trace.end());
        solution = std::move(next);
    }
    return solution;
}

}  // namespace

Fit srivc_by_passes(const IdData& data, const TransferStructure& structure, const FitOptions& options) {
    check_transfer_data("srivc", data, structure);
    Fit estimate;
    estimate.structure = structure;
    SrivcSolution solution = solve(data, structure, options);
    estimate.theta = std::move(solution.theta);
    estimate.termination = solution.termination;
    estimate.trace = std::move(solution.trace);
    measure_simulation(estimate, data);
    set_covariance(estimate, data, options, solution.mirrored ? Matrix() : solution.gram);
    describe_models(estimate);
    const std::string passes = counted(estimate.trace.size(), "pass", "passes");
    if (estimate.termination == Termination::kConverged)
        set_message(estimate, "SRIVC converged after " + passes + ": " + simulation_text(estimate) + ".");
    else
        set_message(estimate, "SRIVC had not settled after " + passes +
                                  "; the best of them is given: " + simulation_text(estimate) + ".");
    return estimate;
}

bool srivc_passes_suffice(const TransferStructure& structure, const FitOptions& options) {
    if (structure.free_delays || options.initial_state != InitialState::kZero || options.offset != Offset::kNone)
        return false;
    if (!options.fixed.empty() || options.output_weights.size() > 0) return false;
    for (Index output = 0; output < structure.outputs; ++output)
        if (!structure.inputs_share_denominator(output)) return false;
    return true;
}

Fit srivc(const IdData& data, const TransferStructure& structure, const FitOptions& options, const SearchAids& aids) {
    options.validate();
    return finished_fit(data, options, [&](const IdData& seen, const FitOptions& wanted) {
        if (!srivc_passes_suffice(structure, wanted) || aids.start.size() > 0)
            return search_transfer("srivc", seen, structure, wanted, aids);
        Fit estimate = srivc_by_passes(seen, structure, wanted);
        if (estimate.termination == Termination::kCancelled) return estimate;
        return search_where_passes_fail(std::move(estimate), seen, wanted, aids);
    });
}

}  // namespace dynlab::inline numerics
