#include "numerics/estimators/ivsvf.h"

#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

Fit ivsvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options) {
    options.validate();
    check_carx("ivsvf", structure);
    check_transfer_data("ivsvf", data, structure);
    Fit estimate;
    estimate.structure = structure;
    estimate.theta.resize(structure.parameter_count());
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    bool mirrored = false;
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        const DenominatorGroup group(data, structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count();
        const double gain = options.beta ? std::pow(*options.beta, static_cast<double>(group.order())) : 1.0;
        const Vector E = filter_denominator(options.lambda, group.order());
        const NormalEquations least_squares = group.svf(E, gain);
        const Vector first = solve_equations(least_squares);
        bool unstable = false;
        double condition = 0;
        NormalEquations sums;
        Vector theta;
        if (first.allFinite()) {
            sums = group.auxiliary(E, group.with_stable_poles(first, &unstable), gain);
            theta = solve_equations(sums, &condition);
        }
        if (theta.size() == 0 || !theta.allFinite())
            throw InvalidArgument(
                "ivsvf: the equations have no unique solution, because the input does not excite the system enough for "
                "{} parameters. Use a richer input or fewer parameters",
                d);
        mirrored = mirrored || unstable;
        const double squares = std::max(
            0.0, least_squares.y_y - 2 * theta.dot(least_squares.z_y) + theta.dot(least_squares.z_phi * theta));
        const Matrix inverse = solve_by_lu(sums.z_phi, Matrix::Identity(d, d)).x;
        estimate.theta.segment(group.place(), d) = theta;
        estimate.covariance.block(group.place(), group.place(), d, d) =
            squares / static_cast<double>(group.sample_count() - d) * inverse * sums.z_z * inverse.transpose();
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
    estimate.termination = Termination::kConverged;
    describe_models(estimate);
    if (mirrored)
        estimate.warnings.push_back(
            Message("The initial least-squares model was unstable; its poles were reflected into the left half plane "
                    "to generate the instruments."));
    warn_of_cutoff(estimate, options.lambda);
    estimate.message = Message("Instrumental variables on filtered signals.");
    return estimate;
}

}  // namespace dynlab::inline numerics
