#include "numerics/fit/polynomial_estimate.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

bool input_is_zero(const IdData& data, Index input) {
    return std::all_of(data.experiments.begin(), data.experiments.end(),
                       [&](const Experiment& experiment) { return experiment.u.col(input).isZero(0); });
}

bool output_is_constant(const IdData& data, Index output) {
    return std::all_of(data.experiments.begin(), data.experiments.end(), [&](const Experiment& experiment) {
        return (experiment.y.col(output).array() == experiment.y(0, output)).all();
    });
}

}  // namespace

void PolynomialOptions::validate() const {
    OutputErrorOptions{MaxIter, Tol, {}}.validate();
}

void warn_of_doubtful_parameters(PolynomialEstimate& estimate) {
    if (estimate.condition_number > kAmbiguousCondition) {
        estimate.warnings.push_back("The data do not tell all parameters apart (condition number " +
                                    number_text(estimate.condition_number, 2) +
                                    "): lower orders or a richer input are wanted.");
        return;
    }
    for (std::size_t i = 0; i < estimate.names.size(); ++i) {
        const Index k = static_cast<Index>(i);
        if (estimate.std[k] > std::abs(estimate.theta[k]))
            estimate.warnings.push_back("The data hardly determine " + estimate.names[i] +
                                        ": its standard error is larger than its value.");
    }
}

void warn_of_termination(PolynomialEstimate& estimate, int max_iterations) {
    if (estimate.termination == Termination::kIterationLimit)
        estimate.warnings.push_back("It had not settled after MaxIter = " + std::to_string(max_iterations) +
                                    " iterations; the best point on the way is given.");
    if (estimate.termination == Termination::kCancelled)
        estimate.warnings.push_back("It was stopped before its end; the best point on the way is given.");
}

std::string ending_text(const PolynomialEstimate& estimate) {
    const bool settled =
        estimate.termination == Termination::kConverged || estimate.termination == Termination::kNoProgress;
    return std::string(settled ? "Converged" : "Stopped") + " after " + iterations_text(estimate.trace.size());
}

double fit_percent_of_sums(double squared_errors, double squared_variations) {
    return 100 * (1 - std::sqrt(squared_errors / squared_variations));
}

void check_sampled_data(const std::string& caller, const IdData& data) {
    if (data.input_count() == 0) throw InvalidArgument(caller + " needs an input, and the data hold none");
    if (!data.regular())
        throw InvalidArgument(caller + " needs regularly sampled data, and these are not: resample them first");
    for (Index input = 0; input < data.input_count(); ++input)
        if (input_is_zero(data, input))
            throw InvalidArgument(caller + ": the input " + data.input_names[static_cast<std::size_t>(input)] +
                                  " is zero throughout, so nothing can be learnt about its effect");
    for (Index output = 0; output < data.output_count(); ++output)
        if (output_is_constant(data, output))
            throw InvalidArgument(caller + ": the output never changes, so nothing can be learnt");
}

void check_polynomial_data(const std::string& caller, const IdData& data, const PolynomialOrders& orders) {
    if (data.output_count() != 1)
        throw InvalidArgument(caller + " needs one output, and the data hold " + std::to_string(data.output_count()) +
                              ": select one");
    if (data.input_count() > 0 && static_cast<std::size_t>(data.input_count()) != orders.inputs())
        throw InvalidArgument(caller + ": the data have " + std::to_string(data.input_count()) +
                              " inputs, so each of nb, nf and nk needs as many values, and " +
                              std::to_string(orders.inputs()) + " were given");
    check_sampled_data(caller, data);
    const int longest_delay = *std::max_element(orders.nk.begin(), orders.nk.end());
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        if (longest_delay >= data.sample_count(e))
            throw InvalidArgument(caller + ": the delay nk = " + std::to_string(longest_delay) +
                                  " samples is not shorter than the record of " + std::to_string(data.sample_count(e)) +
                                  " samples");
}

}  // namespace dynlab::inline numerics
