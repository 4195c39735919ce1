#include "numerics/estimators/lssvf.h"

#include <cmath>

#include "numerics/criteria/estimating_terms.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/statistics/robust_covariance.h"

namespace dynlab::inline numerics {

void SvfOptions::validate() const {
    if (!(lambda > 0) || !std::isfinite(lambda))
        throw InvalidArgument(
            "lambda, the cutoff frequency of the filter, must be a positive number of rad/s, but is {}. Choose a value "
            "slightly above the bandwidth of the system",
            lambda);
    if (beta && (!(*beta > 0) || !std::isfinite(*beta)))
        throw InvalidArgument("beta must be positive, but is {}", *beta);
}

void check_carx(const char* method, const TransferStructure& structure) {
    if (structure.free_delays)
        throw InvalidArgument("{}: this method does not estimate delays; use srivc or coe", method);
    for (Index output = 0; output < structure.outputs; ++output)
        for (Index input = 1; input < structure.inputs; ++input)
            if (structure.channel(output, input).denominator != structure.channel(output, 0).denominator)
                throw InvalidArgument(
                    "{}: this method uses one denominator for all inputs of an output; for separate denominators, use "
                    "srivc or coe",
                    method);
}

void warn_of_cutoff(Fit& estimate, double lambda) {
    constexpr double kFar = 8;
    double fastest = 0;
    for (const TransferFunction& G : estimate.models) fastest = std::max(fastest, G.poles().cwiseAbs().maxCoeff());
    if (lambda > kFar * fastest || lambda < fastest / kFar)
        estimate.warnings.push_back(
            Message("The cutoff frequency lambda = {} rad/s is far from the estimated poles (fastest {} rad/s): choose "
                    "lambda slightly above the bandwidth.",
                    lambda, significant(fastest, 3)));
}

void color_covariance(Fit& fit, const IdData& data, const SvfOptions& options, bool instruments) {
    if (data.sample_count() > kMaxColoredSamples) {
        fit.warnings.push_back(
            Message("For more than {} samples, the standard errors assume a white equation error, although the filters "
                    "make the error colored.",
                    kMaxColoredSamples));
        return;
    }
    for (std::size_t g = 0; g < fit.structure.poles.size(); ++g) {
        const DenominatorGroup group(data, fit.structure, static_cast<Index>(g), options.hold_y);
        const Index d = group.parameter_count();
        const double gain = options.beta ? std::pow(*options.beta, static_cast<double>(group.order())) : 1.0;
        const Vector E = filter_denominator(options.lambda, group.order());
        NormalEquations sums = group.svf(E, gain);
        Vector auxiliary;
        if (instruments) {
            auxiliary = group.with_stable_poles(solve_equations(sums));
            sums = group.auxiliary(E, auxiliary, gain);
        }
        const EstimatingTerms terms =
            estimating_terms(group, E, gain, fit.theta.segment(group.place(), d), instruments ? &auxiliary : nullptr);
        std::vector<Index> lengths;
        for (const DenominatorGroup::Member& member : group.members())
            if (member.output == 0) lengths.push_back(member.data_set.y.size());
        fit.covariance.block(group.place(), group.place(), d, d) =
            robust_covariance(solve_by_lu(sums.z_phi, Matrix::Identity(d, d)).x, terms.Z, terms.errors, lengths,
                              static_cast<Index>(group.outputs().size()))
                .covariance;
    }
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
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
                "lssvf: the equations have no unique solution, because the input does not excite the system enough for "
                "{} parameters. Use a richer input or fewer parameters",
                d);
        const double squares = std::max(0.0, sums.y_y - 2 * theta.dot(sums.z_y) + theta.dot(sums.z_phi * theta));
        const double variance = squares / static_cast<double>(group.sample_count() - d);
        estimate.theta.segment(group.place(), d) = theta;
        estimate.covariance.block(group.place(), group.place(), d, d) = variance * inverse_gram(sums.z_phi);
        estimate.condition_number = std::max(estimate.condition_number, condition);
    }
    estimate.termination = Termination::kConverged;
    describe_models(estimate);
    warn_of_cutoff(estimate, options.lambda);
    estimate.message = Message("Least squares on filtered signals.");
    return estimate;
}

}  // namespace dynlab::inline numerics
