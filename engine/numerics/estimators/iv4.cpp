#include "numerics/estimators/iv4.h"

#include <algorithm>
#include <numeric>

#include "numerics/criteria/discrete_output.h"
#include "numerics/error.h"
#include "numerics/fit/discrete/arma_noise.h"
#include "numerics/fit/discrete/prediction_fit.h"
#include "numerics/fit/equation_error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxFilterLength = 100;

/// The data with outputs that the model simulates from rest, its poles brought into the unit circle.
IdData simulated(const IdData& data, const PolynomialModel& model) {
    IdData result = data;
    const Vector a = reflect_poles_into_unit_circle(model.A.tail(model.A.size() - 1));
    for (Experiment& experiment : result.experiments)
        experiment.y = free_run(a, driven_part(model, experiment.u), Vector::Zero(experiment.y.rows()), 0);
    return result;
}

/// The data filtered by the monic L, without the samples whose past is not recorded.
IdData filtered(const IdData& data, const Vector& L) {
    const Index order = L.size() - 1;
    const ArmaNoise filter{Vector::Ones(1), L, {}};
    IdData result = data;
    result.experiments.clear();
    for (const Experiment& experiment : data.experiments) {
        const Index rows = experiment.y.rows() - order;
        if (rows <= 0) continue;
        Experiment shorter = experiment;
        shorter.y = whitened(filter, experiment.y).bottomRows(rows);
        shorter.u = whitened(filter, experiment.u).bottomRows(rows);
        result.experiments.push_back(std::move(shorter));
    }
    return result;
}

struct InstrumentEstimate {
    Vector theta;
    Matrix unscaled_covariance;   ///< (Z'Phi)^-1 Z'Z (Phi'Z)^-1
    double condition_number = 0;  ///< of Z'Phi, its rows and columns scaled
};

InstrumentEstimate solve_instruments(const ArxEquations& equations, const ArxEquations& instruments) {
    const Index d = equations.parameters();
    const auto [with_equations, gram] = equations.products(instruments);
    const Vector scale = gram.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * with_equations.leftCols(d) * scale.asDiagonal();
    const SingularValues svd = jacobi_svd(scaled);
    const double smallest = static_cast<double>(d) * std::numeric_limits<double>::epsilon() * svd.s[0];
    const Vector weights = (svd.s.array() > smallest).select(svd.s.cwiseInverse(), 0);
    const Matrix inverse = svd.V * weights.asDiagonal() * svd.U.transpose();
    InstrumentEstimate estimate;
    estimate.theta = scale.asDiagonal() * (inverse * (scale.asDiagonal() * with_equations.col(d)));
    const Matrix scaled_gram = scale.asDiagonal() * gram * scale.asDiagonal();
    estimate.unscaled_covariance =
        scale.asDiagonal() * (inverse * scaled_gram * inverse.transpose()) * scale.asDiagonal();
    estimate.condition_number = svd.s[0] / std::max(svd.s[d - 1], 1e-300);
    return estimate;
}

double mean_square(const std::vector<Vector>& errors, Index parameters) {
    double squares = 0;
    Index count = 0;
    for (const Vector& data_set : errors) {
        squares += data_set.squaredNorm();
        count += data_set.size();
    }
    return squares / static_cast<double>(count - parameters);
}

/// The autoregression of step 3.
Vector noise_filter(const std::vector<Vector>& errors, const PolynomialOrders& orders, double power) {
    const int requested = orders.na + std::accumulate(orders.nb.begin(), orders.nb.end(), 0);
    return start_noise(errors, 0, std::min(requested, kMaxFilterLength), power).D;
}

}  // namespace

Fit iv4(const IdData& data, const PolynomialOrders& orders) {
    check_equation_error("iv4", data, orders);
    const PolynomialModel first(orders, solve_rich_arx("iv4", data, orders).theta, data.Ts);
    const ArxEquations equations(data, orders);
    const IdData first_instruments = simulated(data, first);
    const Vector second_theta = solve_instruments(equations, ArxEquations(first_instruments, orders)).theta;
    const PolynomialModel second(orders, second_theta, data.Ts);

    const Vector L = noise_filter(equations.errors(second_theta), orders, output_power(data));
    const IdData whitened_data = filtered(data, L), instruments = filtered(simulated(data, second), L);
    const ArxEquations last(whitened_data, orders);
    if (last.count() <= last.parameters())
        throw InvalidArgument(
            "iv4: the {} samples of the data are too few for the noise filter of order {}. Use more data or lower "
            "orders",
            data.sample_count(), L.size() - 1);
    const InstrumentEstimate solution = solve_instruments(last, ArxEquations(instruments, orders));

    Fit estimate = polynomial_fit(orders, solution.theta, data.Ts);
    report_equation_error(estimate, data);
    estimate.covariance = mean_square(last.errors(solution.theta), last.parameters()) * solution.unscaled_covariance;
    estimate.condition_number = solution.condition_number;
    describe_equation_error(estimate);
    warn_of_operating_point(estimate, data);
    estimate.message = Message(
        "Instrumental variables with {} equations: fit {} % for one-step prediction, {} % for simulation from measured "
        "past values.",
        last.count(), significant(estimate.prediction_fit_percent, 4), significant(estimate.fit_percent[0], 4));
    return estimate;
}

}  // namespace dynlab::inline numerics
