#include "numerics/estimators/lssvf.h"

#include <cmath>

#include "numerics/criteria/estimating_terms.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/number_text.h"
#include "numerics/validation/robust_covariance.h"

namespace dynlab::inline numerics {

void SvfOptions::validate() const {
    if (!(lambda > 0) || !std::isfinite(lambda))
        throw InvalidArgument(
            "lambda, the cut-off frequency of the filter, must be a positive number of rad/s, a bit above the "
            "bandwidth of the system, and is " +
            number_text(lambda));
    if (beta && (!(*beta > 0) || !std::isfinite(*beta)))
        throw InvalidArgument("beta must be positive, and is " + number_text(*beta));
}

void check_carx(const char* method, const TransferStructure& structure) {
    if (structure.free_delays)
        throw InvalidArgument(std::string(method) + ": delays are fixed here; srivc and coe estimate them");
    for (Index output = 0; output < structure.outputs; ++output)
        for (Index input = 1; input < structure.inputs; ++input)
            if (structure.channel(output, input).denominator != structure.channel(output, 0).denominator)
                throw InvalidArgument(std::string(method) +
                                      ": the inputs of an output share their denominator here; srivc and coe give each "
                                      "its own");
}

void warn_of_cutoff(Fit& estimate, double lambda) {
    constexpr double kFar = 8;
    double fastest = 0;
    for (const TransferFunction& G : estimate.models) fastest = std::max(fastest, G.poles().cwiseAbs().maxCoeff());
    if (lambda > kFar * fastest || lambda < fastest / kFar)
        estimate.warnings.push_back("The cut-off frequency lambda = " + number_text(lambda) +
                                    " rad/s lies far from the poles found (fastest " + number_text(fastest, 3) +
                                    " rad/s): the usual choice is a bit above the bandwidth.");
}

Matrix equation_covariance(const DenominatorGroup& group, const VectorView& E, double gain, const Matrix& H,
                           const Vector& theta, const Vector* instrument) {
    const EstimatingTerms terms = estimating_terms(group, E, gain, theta, instrument);
    std::vector<Index> lengths;
    for (const DenominatorGroup::Member& member : group.members())
        if (member.output == 0) lengths.push_back(member.record.y.size());
    return robust_covariance(H, terms.Z, terms.errors, lengths, static_cast<Index>(group.outputs().size())).covariance;
}

void warn_of_white_errors(Fit& estimate, const IdData& data) {
    if (data.sample_count() > kMostColoured)
        estimate.warnings.push_back("Standard errors of more than " + std::to_string(kMostColoured) +
                                    " samples take the equation error as white, though the filters colour it.");
}

Fit lssvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options) {
    options.validate();
    check_carx("lssvf", structure);
    check_transfer_data("lssvf", data, structure);
    Fit estimate;
    estimate.structure = structure;
    estimate.theta.resize(structure.parameter_count());
    estimate.covariance = Matrix::Zero(estimate.theta.size(), estimate.theta.size());
    for (std::size_t g = 0; g < structure.poles.size(); ++g) {
        const DenominatorGroup group(data, structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count();
        const double gain = options.beta ? std::pow(*options.beta, static_cast<double>(group.order())) : 1.0;
        const Vector E = filter_denominator(options.lambda, group.order());
        const NormalEquations sums = group.svf(E, gain);
        double condition = 0;
        const Vector theta = solve_equations(sums, &condition);
        if (!theta.allFinite())
            throw InvalidArgument(
                "lssvf: the equations have no unique solution: the input does not excite the system enough for " +
                std::to_string(d) + " parameters");
        const Matrix inverse = inverse_gram(sums.z_phi);
        const double squares = std::max(0.0, sums.y_y - 2 * theta.dot(sums.z_y) + theta.dot(sums.z_phi * theta));
        estimate.theta.segment(group.place(), d) = theta;
        estimate.covariance.block(group.place(), group.place(), d, d) =
            data.sample_count() <= kMostColoured ? equation_covariance(group, E, gain, inverse, theta)
                                                 : squares / static_cast<double>(group.sample_count() - d) * inverse;
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
    estimate.termination = Termination::kConverged;
    describe_models(estimate);
    warn_of_cutoff(estimate, options.lambda);
    warn_of_white_errors(estimate, data);
    set_message(estimate, "Least squares on filtered signals.");
    return estimate;
}

}  // namespace dynlab::inline numerics
