#include "numerics/estimators/srivc.h"

#include "numerics/kernels/refined_iteration.h"
#include "numerics/kernels/simulation_report.h"

namespace dynlab {

namespace {

constexpr Index kTrialSamples = 50'000;  // the start for a longer record is found on its beginning
constexpr double kTrialTolerance = 1e-4;
constexpr int kReweightings = 3;

Vector start_of(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    if (!options.lambda) return find_start(data, structure, options.hold_y, options.cancel);
    const Vector theta = filtered_start(data, structure, *options.lambda, options.hold_y);
    return theta.allFinite() ? theta : find_start(data, structure, options.hold_y, options.cancel);
}

/// Where the passes over the whole record begin: for a long one with the passes' result on its beginning.
Vector start_for(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    if (data.sample_count() <= 2 * kTrialSamples) return start_of(data, structure, options);
    const IdData beginning = beginning_of(data, kTrialSamples);
    const Vector start = start_of(beginning, structure, options);
    const RefinedSolution trial = iterate_refined(
        beginning, structure, start, {options.MaxIter, kTrialTolerance, options.hold_y, options.cancel, {}});
    return trial.termination == Termination::kConverged ? trial.theta : start_of(data, structure, options);
}

/// (sum Z'Z/noise variance)^-1 of each denominator group.
void set_covariance(TransferEstimate& estimate, const IdData& data, const TransferOptions& options) {
    const TransferStructure& structure = estimate.structure;
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        DenominatorGroup group(data, structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count(), place = group.place();
        const double largest = estimate.noise_variance.maxCoeff();  // keeps the weights finite without noise
        for (const Index output : group.outputs())
            group.set_weight(output, largest > 0 ? largest / estimate.noise_variance[output] : 1);
        double condition = 0;
        const Matrix gram = group.sensitivity_gram(estimate.theta.segment(place, d));
        estimate.covariance.block(place, place, d, d) = largest * inverse_gram(gram, &condition);
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
}

bool outputs_share_a_denominator(const TransferStructure& structure) {
    return structure.poles.size() < static_cast<std::size_t>(structure.outputs);
}

/// The passes; where outputs share a denominator, repeated with each output weighted by its noise.
RefinedSolution solve(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    RefinedOptions refined{options.MaxIter, options.Tol, options.hold_y, options.cancel, {}};
    RefinedSolution solution = iterate_refined(data, structure, start_for(data, structure, options), refined);
    for (int i = 0; outputs_share_a_denominator(structure) && i < kReweightings; ++i) {
        refined.weights.resize(structure.outputs);
        for (Index output = 0; output < structure.outputs; ++output)
            refined.weights[output] = 1 / simulation_squares(data, structure, solution.theta, output);
        if (!refined.weights.allFinite()) break;
        refined.weights /= refined.weights.maxCoeff();
        solution = iterate_refined(data, structure, solution.theta, refined);
    }
    return solution;
}

}  // namespace

TransferEstimate srivc(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    options.validate();
    check_transfer_data("srivc", data, structure);
    TransferEstimate estimate;
    estimate.structure = structure;
    RefinedSolution solution = solve(data, structure, options);
    estimate.theta = std::move(solution.theta);
    estimate.termination = solution.termination;
    estimate.trace = std::move(solution.trace);
    measure_fit(estimate, data);
    set_covariance(estimate, data, options);
    report_errors(estimate);
    const std::string passes = std::to_string(estimate.trace.size()) + " passes";
    if (estimate.termination == Termination::kConverged)
        set_message(estimate, "SRIVC converged after " + passes);
    else
        set_message(estimate, "SRIVC had not settled after " + passes + "; the best of them is given");
    return estimate;
}

}  // namespace dynlab
