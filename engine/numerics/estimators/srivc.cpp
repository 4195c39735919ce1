#include "numerics/estimators/srivc.h"

#include <Eigen/Dense>
#include <cmath>

#include "numerics/kernels/refined_iteration.h"
#include "numerics/kernels/transfer_report.h"

namespace dynlab {

namespace {

constexpr Index kTrialSamples = 50'000;  // the start for a longer record is found on its beginning
constexpr double kTrialTolerance = 1e-4;

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
    const RefinedSolution trial = iterate_refined(beginning, structure, start,
                                                  {options.MaxIter, kTrialTolerance, options.hold_y, options.cancel});
    return trial.termination == Termination::kConverged ? trial.theta : start_of(data, structure, options);
}

/// Covariance of all parameters for unit noise: each group's (Z'Z)^-1 times its outputs' noise variance.
void set_covariance(TransferEstimate& estimate, const IdData& data, Hold hold_y) {
    const TransferStructure& structure = estimate.structure;
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        const DenominatorGroup group(data, structure, static_cast<Index>(g), hold_y);
        const Index d = group.parameter_count(), place = group.place();
        const Vector theta = estimate.theta.segment(place, d);
        RegressionMoments sums = group.refined(theta, true);
        const double variance = group.error_squares(theta) / static_cast<double>(group.sample_count() - d);
        const Vector scale = sums.z_z.diagonal().cwiseSqrt();
        const Matrix scaled = scale.cwiseInverse().asDiagonal() * sums.z_z * scale.cwiseInverse().asDiagonal();
        estimate.covariance.block(place, place, d, d) =
            variance * (scale.cwiseInverse().asDiagonal() * scaled.ldlt().solve(Matrix::Identity(d, d)) *
                        scale.cwiseInverse().asDiagonal());
        double condition = 0;
        sums.z_phi = sums.z_z;
        solve_moments(sums, &condition);
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
}

}  // namespace

TransferEstimate srivc(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    options.validate();
    check_transfer_data("srivc", data, structure);
    TransferEstimate estimate;
    estimate.structure = structure;
    const Vector start = start_for(data, structure, options);
    RefinedSolution solution =
        iterate_refined(data, structure, start, {options.MaxIter, options.Tol, options.hold_y, options.cancel});
    estimate.theta = std::move(solution.theta);
    estimate.termination = solution.termination;
    estimate.trace = std::move(solution.trace);
    set_covariance(estimate, data, options.hold_y);
    report_on(estimate, data);
    const std::string passes = std::to_string(estimate.trace.size()) + " passes";
    if (estimate.termination == Termination::kConverged)
        set_message(estimate, "SRIVC converged after " + passes);
    else
        set_message(estimate, "SRIVC had not settled after " + passes + "; the best of them is given");
    return estimate;
}

}  // namespace dynlab
