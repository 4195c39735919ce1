#include "numerics/fit/data_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesPerParameter = 3;

std::string numbered(const char* what, Index place, Index count) {
    return count == 1 ? std::string("the ") + what : std::string(what) + " " + std::to_string(place + 1);
}

bool is_constant(const Eigen::Ref<const Vector>& x) {
    return (x.array() == x[0]).all();
}

template <class Holds>
bool in_all_experiments(const IdData& data, const Holds& holds) {
    return std::all_of(data.experiments.begin(), data.experiments.end(), holds);
}

/// A constant input is a step from zero at the first sample, when the output begins there as well.
bool starts_from_rest(const Eigen::Ref<const Vector>& y) {
    return std::abs(y[0]) < 0.5 * y.cwiseAbs().maxCoeff();
}

void check_inputs(const std::string& method, const IdData& data) {
    if (data.input_count() == 0) throw InvalidArgument(method + " needs an input, and the data have no input");
    for (Index input = 0; input < data.input_count(); ++input)
        if (in_all_experiments(data, [&](const Experiment& e) { return e.u.col(input).isZero(0); }))
            throw InvalidArgument(method + ": the input " + data.input_names[static_cast<std::size_t>(input)] +
                                  " is zero throughout: it does not excite the system, and its effect cannot be "
                                  "estimated");
}

void check_outputs(const std::string& method, const IdData& data) {
    for (Index output = 0; output < data.output_count(); ++output)
        if (in_all_experiments(data, [&](const Experiment& e) { return is_constant(e.y.col(output)); }))
            throw InvalidArgument(method + ": " + numbered("output", output, data.output_count()) +
                                  " never changes, so no dynamics can be estimated");
}

}  // namespace

void check_signals(const std::string& method, const IdData& data) {
    check_inputs(method, data);
    check_outputs(method, data);
}

void check_transfer_data(const std::string& method, const IdData& data, const TransferStructure& structure) {
    structure.validate();
    check_inputs(method, data);
    if (data.input_count() != structure.inputs || data.output_count() != structure.outputs)
        throw InvalidArgument(method + ": the model has " + std::to_string(structure.inputs) + " input(s) and " +
                              std::to_string(structure.outputs) + " output(s), and the data have " +
                              std::to_string(data.input_count()) + " and " + std::to_string(data.output_count()));
    const Index wanted = kSamplesPerParameter * structure.parameter_count();
    if (data.sample_count() < wanted)
        throw InvalidArgument(method + ": at least " + std::to_string(wanted) + " samples are needed for " +
                              std::to_string(structure.parameter_count()) + " parameters, and the data hold " +
                              std::to_string(data.sample_count()));
    for (const TransferChannel& channel : structure.channels)
        for (std::size_t e = 0; e < data.experiments.size(); ++e)
            if (channel.delay >= data.duration(e))
                throw InvalidArgument(method + ": the delay of " + number_text(channel.delay) +
                                      " s is not shorter than the record of " + number_text(data.duration(e)) + " s");
    for (Index input = 0; input < data.input_count(); ++input)
        if (in_all_experiments(data, [&](const Experiment& e) {
                return is_constant(e.u.col(input)) && !starts_from_rest(e.y.col(0));
            }))
            throw InvalidArgument(method + ": " + numbered("input", input, data.input_count()) +
                                  " never changes and the output does not start from rest, so there is no excitation: "
                                  "let the input vary, for instance as a prbs");
    check_outputs(method, data);
}

void check_sampled_data(const std::string& method, const IdData& data) {
    if (data.input_count() > 0 && !data.regular())
        throw InvalidArgument(method + " needs regularly sampled data, and these are not: resample them first");
    check_signals(method, data);
}

void check_polynomial_data(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    if (data.output_count() != 1)
        throw InvalidArgument(method + " needs one output, and the data hold " + std::to_string(data.output_count()) +
                              ": select one");
    if (data.input_count() > 0 && static_cast<std::size_t>(data.input_count()) != orders.inputs())
        throw InvalidArgument(method + ": the data have " + std::to_string(data.input_count()) +
                              " inputs, so each of nb, nf and nk needs as many values, and " +
                              std::to_string(orders.inputs()) + " were given");
    check_sampled_data(method, data);
    const int longest_delay = *std::max_element(orders.nk.begin(), orders.nk.end());
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
        if (longest_delay >= data.sample_count(e))
            throw InvalidArgument(method + ": the delay nk = " + std::to_string(longest_delay) +
                                  " samples is not shorter than the record of " + std::to_string(data.sample_count(e)) +
                                  " samples");
}

void check_sample_count(const std::string& method, Index samples, Index values) {
    if (samples > values) return;
    throw InvalidArgument(method + " needs more samples than the " + std::to_string(values) +
                          " values it estimates, and the record holds " + std::to_string(samples));
}

void check_transient(const std::string& method, const IdData& data, const Fit& fit, Index values) {
    if (fit.termination == Termination::kCancelled) return;
    for (const Experiment& experiment : data.experiments)
        for (Index input = 0; input < data.input_count(); ++input)
            if (!is_constant(experiment.u.col(input))) return;
    const Index outputs = data.output_count(), N = data.sample_count() * outputs;
    const auto experiments = outputs * static_cast<Index>(data.experiments.size());
    require_transient(method, {fit.loss, output_variations(data).sum() / static_cast<double>(N),
                               output_powers(data).mean(), N, values, experiments});
}

double shortest_record(const IdData& data) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < data.experiments.size(); ++e) shortest = std::min(shortest, data.duration(e));
    return shortest;
}

DelayRange delay_range(const IdData& data, const FitOptions& options) {
    const double shortest = shortest_record(data);
    const double largest = options.largest_delay.value_or(std::max(options.least_delay, shortest / 4));
    if (largest >= shortest)
        throw InvalidArgument("`largest_delay` must be shorter than the record of " + number_text(shortest) +
                              " s, and is " + number_text(largest) + " s");
    return {options.least_delay, largest};
}

}  // namespace dynlab::inline numerics
