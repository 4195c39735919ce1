#include "numerics/fit/equation_error.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/error.h"
#include "numerics/fit/discrete/discrete_fit.h"
#include "numerics/fit/first_estimate.h"
#include "numerics/fit/operating_points.h"
#include "numerics/linalg/least_squares.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kPoorCondition = 1e8;  // beyond it a poor input may be the reason
constexpr double kWorse = 5;            // per cent of fit

void require_rich_inputs(const std::string& method, const MatrixView& R, const PolynomialOrders& orders,
                         const IdData& data) {
    for (std::size_t input = 0; input < orders.inputs(); ++input) {
        const Matrix columns = R.middleCols(orders.b_start(input), orders.nb[input]);
        if (solve_least_squares(columns, Vector::Zero(R.rows())).condition_number < kAmbiguousCondition) continue;
        throw InvalidArgument(
            "{}: the input {} is not persistently exciting of order nb = {} (a constant or a single sine is not "
            "sufficient). Excite the system with a richer input, such as a PRBS, or decrease nb",
            method, data.input_names[input], orders.nb[input]);
    }
}

struct Sums {
    double variation = 0, prediction_error = 0, simulation_error = 0;
};

Sums sums_of_squares(const IdData& data, const ArxEquations& equations, const Fit& estimate) {
    Sums sums;
    for (const Vector& errors : equations.errors(estimate.theta)) sums.prediction_error += errors.squaredNorm();
    for (const Experiment& experiment : data.experiments) {
        const Index past = estimate.orders->past(), rows = experiment.y.rows() - past;
        if (rows <= 0) continue;
        const auto y = experiment.y.col(0).tail(rows);
        const Vector simulated = free_run(estimate.polynomial->A.tail(estimate.orders->na),
                                          driven_part(*estimate.polynomial, experiment.u), experiment.y.col(0), past);
        sums.variation += (y.array() - y.mean()).matrix().squaredNorm();
        sums.simulation_error += (simulated.tail(rows) - y).squaredNorm();
    }
    return sums;
}

/// Simulation fit of the same equations about the operating point, where it is much better than that of the data as
/// they are: a difference equation goes through the origin.
std::optional<double> better_without_means(const IdData& data, const Fit& estimate) {
    const IdData centered = without_operating_points(data).data;
    const ArxEquations equations(centered, *estimate.orders);
    const Fit about = polynomial_fit(*estimate.orders, solve_arx(equations).theta, data.Ts);
    const Sums sums = sums_of_squares(centered, equations, about);
    const double fit = fit_percent_of_sums(sums.simulation_error, sums.variation);
    return fit > estimate.fit_percent[0] + kWorse ? std::optional(fit) : std::nullopt;
}

/// The smallest output error of the same orders, where an offset of the output is part of it and it simulates much
/// better: noise biases the equations, so that they do not show the offset themselves.
std::optional<Fit> better_with_offset(const IdData& data, const Fit& estimate) {
    constexpr Index kEnough = 3000;  // samples
    const PolynomialOrders& own = *estimate.orders;
    if (data.experiments.size() > 1 || own.na == 0) return std::nullopt;
    const std::vector<int> poles(own.inputs(), own.na);
    const FitOptions options;
    try {
        Fit fit = fit_discrete_output("arx", beginning_of(data, kEnough),
                                      PolynomialOrders::output_error(own.nb, poles, own.nk), options,
                                      output_error_search(options));
        if (fit.start.offset && fit.fit_percent[0] > estimate.fit_percent[0] + kWorse) return fit;
    } catch (const InvalidArgument&) {
        return std::nullopt;  // too little happens there
    }
    return std::nullopt;
}

}  // namespace

void check_equation_error(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    orders.validate();
    if (orders.nc + orders.nd > 0 || std::any_of(orders.nf.begin(), orders.nf.end(), [](int nf) { return nf > 0; }))
        throw InvalidArgument("{} has only the orders na, nb and nk: nc, nd and nf must be zero", method);
    check_polynomial_data(method, data, orders);
    const Index d = orders.parameter_count(), equations = ArxEquations(data, orders).count();
    if (equations > d) return;
    throw InvalidArgument(
        "{} estimates {} and needs more equations than parameters, but the data provide only {}. The data have {}, and "
        "the first {} of each experiment are used as past values. Use more data or lower orders",
        method, plural(d, "{} parameter", "{} parameters"), equations,
        plural(data.sample_count(), "{} sample", "{} samples"), orders.past());
}

ArxSolution solve_rich_arx(const std::string& method, const IdData& data, const PolynomialOrders& orders) {
    const ArxEquations equations(data, orders);
    ArxSolution solution = solve_arx(equations);
    if (!(solution.condition_number < kPoorCondition))
        require_rich_inputs(method, equations.triangular_factor(), orders, data);
    return solution;
}

void report_equation_error(Fit& estimate, const IdData& data) {
    const ArxEquations equations(data, *estimate.orders);
    const Index count = equations.count(), d = estimate.theta.size();
    const Sums sums = sums_of_squares(data, equations, estimate);
    estimate.loss = sums.prediction_error / static_cast<double>(count);
    estimate.noise_variance = Vector::Constant(1, sums.prediction_error / static_cast<double>(count - d));
    estimate.fit_percent = Vector::Constant(1, fit_percent_of_sums(sums.simulation_error, sums.variation));
    estimate.prediction_fit_percent = fit_percent_of_sums(sums.prediction_error, sums.variation);
    estimate.start = {InitialState::kEstimate, false};
    estimate.offsets = Matrix::Zero(static_cast<Index>(data.experiments.size()), 1);
}

void warn_of_operating_point(Fit& estimate, const IdData& data) {
    constexpr Index kSamplesPerParameter = 5;  // fewer fit about any point
    if (!(estimate.fit_percent[0] < estimate.prediction_fit_percent - kWorse) || data.input_count() == 0 ||
        data.sample_count() < kSamplesPerParameter * estimate.theta.size())
        return;
    if (const std::optional<Fit> other = better_with_offset(data, estimate))
        estimate.warnings.push_back(Message(
            "With an offset of {} in {}, the simulation fit of sriv or oe is {} % instead of {} %. The difference "
            "equation has no constant term, and noise biases its coefficients. Remove the offset and use sriv or oe.",
            significant(other->offsets(0, 0), 3), data.output_names.front(), significant(other->fit_percent[0], 4),
            significant(estimate.fit_percent[0], 4)));
    else if (const std::optional<double> better = better_without_means(data, estimate))
        estimate.warnings.push_back(Message(
            "Without the means of the signals, the simulation fit is {} % instead of {} %. The difference equation has "
            "no constant term, but these data have an offset. Remove the means with data:remove_mean().",
            significant(*better, 4), significant(estimate.fit_percent[0], 4)));
}

void describe_equation_error(Fit& estimate) {
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    warn_of_doubtful_parameters(estimate);
    warn_of_unstable_polynomials(estimate);
}

}  // namespace dynlab::inline numerics
