#include "numerics/validation/simulation_spread.h"

#include <algorithm>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/prediction.h"

namespace dynlab::inline numerics {

namespace {

/// L with L L' = covariance, by the eigenvalues of the correlations: parameters of very different size keep theirs.
Matrix root_of_covariance(const Matrix& covariance) {
    const Vector std = covariance.diagonal().cwiseMax(0).cwiseSqrt();
    const Vector scale = (std.array() > 0).select(std.cwiseInverse(), 0);
    const auto [values, vectors] = symmetric_eigen(scale.asDiagonal() * covariance * scale.asDiagonal());
    return std.asDiagonal() * vectors * values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

Vector simulated_sum(const std::vector<TransferFunction>& models, const MatrixView& u, double Ts, Hold hold) {
    Vector y = lsim(models.front(), u.col(0), Ts, hold);
    for (Index input = 1; input < u.cols(); ++input)
        y += lsim(models[static_cast<std::size_t>(input)], u.col(input), Ts, hold);
    return y;
}

}  // namespace

SimulationSpread simulation_spread(const ModelsOfParameters& models, const Vector& theta, const Matrix& covariance,
                                   const MatrixView& u, double Ts, Hold hold, Index runs, RandomStream& random) {
    const Index d = theta.size();
    if (runs < 2) throw InvalidArgument("The number of runs must be at least 2, but is {}", runs);
    constexpr Index kMaxSimulatedValues = 50'000'000;
    const Index N = u.rows();
    if (N > kMaxSimulatedValues / runs)
        throw InvalidArgument("A simulation of {} runs of {} samples is too large: use a shorter input or fewer runs",
                              runs, N);
    if (covariance.rows() != d || covariance.cols() != d || !covariance.allFinite())
        throw InvalidArgument(
            "The spread needs a finite covariance matrix of the {} parameters, but got a {} x {} matrix", d,
            covariance.rows(), covariance.cols());
    const std::vector<TransferFunction> own = models(theta);
    if (u.cols() != static_cast<Index>(own.size()))
        throw InvalidArgument(plural(static_cast<Index>(own.size()),
                                     "The model has {} input, but the number of specified inputs is {}",
                                     "The model has {} inputs, but the number of specified inputs is {}", u.cols()));
    const Matrix root = root_of_covariance(covariance);
    SimulationSpread spread{simulated_sum(own, u, Ts, hold), {}, Matrix(N, runs), 0};
    for (Index run = 0; run < runs; ++run) {
        const std::vector<TransferFunction> drawn = models(theta + root * random.normal(d));
        if (!std::ranges::all_of(drawn, [](const TransferFunction& G) { return G.stable(); })) ++spread.unstable;
        spread.drawn.col(run) = simulated_sum(drawn, u, Ts, hold);
    }
    const Vector mean = spread.drawn.rowwise().mean();
    spread.std = ((spread.drawn.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(runs - 1)).cwiseSqrt();
    return spread;
}

SimulationSpread simulation_spread(const UncertainModel& model, const VectorView& u, double Ts, Hold hold, Index runs,
                                   RandomStream& random) {
    const TransferFunction& G = model.G;
    const Index n = G.pole_count(), m = G.zero_count();
    Vector theta(model.covariance.rows());
    theta.head(n + m + 1) << G.den().tail(n), G.num();
    if (model.free_delay()) theta[n + m + 1] = G.delay();
    const auto of_coefficients = [&](const Vector& drawn) {
        const double delay = model.free_delay() ? std::max(0.0, drawn[n + m + 1]) : G.delay();
        return std::vector{TransferFunction(drawn.segment(n, m + 1), monic(drawn.head(n)), 0, delay)};
    };
    return simulation_spread(of_coefficients, theta, model.covariance, u, Ts, hold, runs, random);
}

SimulationSpread simulation_spread(const TransferStructure& structure, const Vector& theta, const Matrix& covariance,
                                   const MatrixView& u, double Ts, Hold hold, Index runs, RandomStream& random) {
    if (structure.outputs != 1)
        throw InvalidArgument("The spread requires a model with one output, but this model has {}", structure.outputs);
    const auto of_parameters = [&](Vector drawn) {
        for (Index input = 0; input < structure.inputs && structure.free_delays; ++input) {
            double& delay = drawn[structure.delay_index(0, input)];
            delay = std::max(0.0, delay);
        }
        return structure.models(drawn);
    };
    return simulation_spread(of_parameters, theta, covariance, u, Ts, hold, runs, random);
}

SimulationSpread simulation_spread(const PolynomialModel& model, const Matrix& covariance, const MatrixView& u,
                                   Index runs, RandomStream& random) {
    const auto [orders, theta] = ordered_parameters(model);
    const auto of_parameters = [&orders = orders, Ts = model.Ts](const Vector& drawn) {
        const PolynomialModel other(orders, drawn, Ts);
        std::vector<TransferFunction> models;
        for (std::size_t input = 0; input < orders.inputs(); ++input) models.push_back(other.transfer_function(input));
        return models;
    };
    return simulation_spread(of_parameters, theta, covariance, u, model.Ts, Hold::kZoh, runs, random);
}

}  // namespace dynlab::inline numerics
