#include "numerics/estimators/oe.h"

#include "numerics/kernels/discrete_fit.h"

namespace dynlab {

namespace {

constexpr int kRoughIterations = 20;
constexpr double kRoughTolerance = 1e-3;

InstrumentSolution search(const DiscreteOutput& model, const Vector& y, const PolynomialOptions& options) {
    const Vector start = instrument_start(model, y, options.cancel);
    const InstrumentSolution rough =
        iterate_instruments(model, y, start, kRoughIterations, kRoughTolerance, options.cancel);
    const OutputErrorSolution end =
        minimise_output_error(model, y, rough.theta, {options.MaxIter, options.Tol, options.cancel});
    InstrumentSolution solution;
    solution.theta = end.theta;
    solution.loss = end.loss;
    solution.termination = end.termination;
    for (const OutputErrorIteration& iteration : end.trace)
        solution.trace.push_back({iteration.loss, iteration.change});
    return solution;
}

}  // namespace

PolynomialEstimate oe(const IdData& data, const PolynomialOrders& orders, const PolynomialOptions& options) {
    return fit_discrete_output("oe", data, orders, options,
                               [&](const DiscreteOutput& model, const Vector& y) { return search(model, y, options); });
}

}  // namespace dynlab
