#include "numerics/estimators/arx.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/number_text.h"

namespace dynlab {

namespace {

constexpr Index kBlock = 1024;      // equations worked on together: they stay in the processor's cache
constexpr double kGramLimit = 1e3;  // beyond this condition number the Gram matrix costs digits

/// The equations [Phi y] of all experiments, made block by block.
class Regression {
  public:
    Regression(const IdData& data, const PolynomialOrders& orders) : data_(data), orders_(orders) {}

    Index equations() const {
        Index count = 0;
        for (const Experiment& experiment : data_.experiments)
            count += std::max<Index>(0, experiment.y.rows() - orders_.past());
        return count;
    }

    /// Calls use(block) with up to kBlock rows [-y(k-1) .. u(k-nk) .. y(k)] at a time.
    template <class Use>
    void for_each_block(Use use) const {
        Matrix block(kBlock, orders_.parameter_count() + 1);
        for (const Experiment& experiment : data_.experiments)
            for (Index k = orders_.past(); k < experiment.y.rows(); k += kBlock) {
                const Index rows = std::min(kBlock, experiment.y.rows() - k);
                fill(experiment, k, rows, block);
                use(block.topRows(rows));
            }
    }

  private:
    void fill(const Experiment& experiment, Index k, Index rows, Matrix& block) const {
        Index column = 0;
        for (int i = 1; i <= orders_.na; ++i)
            block.col(column++).head(rows) = -experiment.y.col(0).segment(k - i, rows);
        for (std::size_t input = 0; input < orders_.inputs(); ++input)
            for (int j = 0; j < orders_.nb[input]; ++j)
                block.col(column++).head(rows) =
                    experiment.u.col(static_cast<Index>(input)).segment(k - orders_.nk[input] - j, rows);
        block.col(column).head(rows) = experiment.y.col(0).segment(k, rows);
    }

    const IdData& data_;
    const PolynomialOrders& orders_;
};

struct Solution {
    Vector theta;
    Matrix inverse_gram;
    double condition_number = 0;
};

/// By the column-scaled Gram matrix; the condition number alone is right when it is too large.
Solution solve_gram(const Regression& regression, Index d) {
    Matrix gram = Matrix::Zero(d + 1, d + 1);
    regression.for_each_block([&](const auto& block) { gram.noalias() += block.transpose() * block; });
    Vector unscale = gram.diagonal().head(d).cwiseSqrt();
    for (double& value : unscale) value = value > 0 ? 1 / value : 1;
    const Matrix scaled = unscale.asDiagonal() * gram.topLeftCorner(d, d) * unscale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scaled);
    Solution solution;
    solution.condition_number = std::sqrt(eigen.eigenvalues()[d - 1] / std::max(eigen.eigenvalues()[0], 1e-300));
    const Matrix V = unscale.asDiagonal() * eigen.eigenvectors();
    solution.inverse_gram = V * eigen.eigenvalues().cwiseInverse().asDiagonal() * V.transpose();
    solution.theta = unscale.asDiagonal() * scaled.ldlt().solve(unscale.asDiagonal() * gram.col(d).head(d));
    return solution;
}

/// The triangular factor of [Phi y].
Matrix triangular_factor(const Regression& regression, Index d) {
    Matrix R = Matrix::Zero(d + 1, d + 1), stack(d + 1 + kBlock, d + 1);
    regression.for_each_block([&](const auto& block) {
        const Index rows = d + 1 + block.rows();
        stack.topRows(d + 1) = R;
        stack.middleRows(d + 1, block.rows()) = block;
        const Eigen::HouseholderQR<Matrix> qr(stack.topRows(rows));
        R = qr.matrixQR().topRows(d + 1).template triangularView<Eigen::Upper>();
    });
    return R;
}

void require_rich_inputs(const MatrixView& R, const PolynomialOrders& orders, const IdData& data) {
    for (std::size_t input = 0; input < orders.inputs(); ++input) {
        const Matrix columns = R.middleCols(orders.b_place(input), orders.nb[input]);
        if (solve_least_squares(columns, Vector::Zero(R.rows())).condition_number < kAmbiguousCondition) continue;
        throw InvalidArgument(
            "arx: the input " + data.input_names[input] +
            " is too poor to tell nb = " + std::to_string(orders.nb[input]) +
            " coefficients apart (as a constant or a single sine is): excite the system with an input "
            "that changes more, or lower nb");
    }
}

Solution solve_triangular(const Regression& regression, const PolynomialOrders& orders, const IdData& data) {
    const Index d = orders.parameter_count();
    const Matrix R = triangular_factor(regression, d);
    require_rich_inputs(R.topLeftCorner(d, d), orders, data);
    const LeastSquares fit = solve_least_squares(R.topLeftCorner(d, d), R.col(d).head(d));
    return {fit.solution, fit.inverse_gram, fit.condition_number};
}

Solution solve(const Regression& regression, const PolynomialOrders& orders, const IdData& data) {
    const Solution quick = solve_gram(regression, orders.parameter_count());
    return quick.condition_number < kGramLimit ? quick : solve_triangular(regression, orders, data);
}

/// The model's free run from the recorded past: N values, the first ones recorded.
Vector simulation(const Experiment& experiment, const PolynomialEstimate& estimate) {
    const PolynomialModel& model = estimate.model;
    const Index first = std::min<Index>(estimate.orders.past(), experiment.y.rows());
    Vector y = experiment.y.col(0);
    for (Index k = first; k < y.size(); ++k) {
        double value = 0;
        for (Index i = 1; i < model.A.size(); ++i) value -= model.A[i] * y[k - i];
        for (std::size_t input = 0; input < model.B.size(); ++input)
            for (Index j = estimate.orders.nk[input]; j < model.B[input].size(); ++j)
                value += model.B[input][j] * experiment.u(k - j, static_cast<Index>(input));
        y[k] = value;
    }
    return y;
}

struct Sums {
    double variation = 0, prediction_error = 0, simulation_error = 0;
};

Sums sums_of_squares(const IdData& data, const Regression& regression, const PolynomialEstimate& estimate) {
    Sums sums;
    const Index d = estimate.theta.size();
    regression.for_each_block([&](const auto& block) {
        sums.prediction_error += (block.col(d) - block.leftCols(d) * estimate.theta).squaredNorm();
    });
    for (const Experiment& experiment : data.experiments) {
        const Index rows = experiment.y.rows() - estimate.orders.past();
        if (rows <= 0) continue;
        const auto y = experiment.y.col(0).tail(rows);
        sums.variation += (y.array() - y.mean()).matrix().squaredNorm();
        sums.simulation_error += (simulation(experiment, estimate).tail(rows) - y).squaredNorm();
    }
    return sums;
}

void add_warnings(PolynomialEstimate& estimate) {
    warn_of_doubtful_parameters(estimate);
    if (!estimate.model.noise_model().stable())
        estimate.warnings.push_back("The model is unstable, so its simulation grows without bound.");
}

void check_arx(const IdData& data, const PolynomialOrders& orders, Index equations) {
    const Index d = orders.parameter_count();
    if (equations > d) return;
    throw InvalidArgument("arx needs more equations than its " + std::to_string(d) +
                          " parameters, and the record gives " + std::to_string(equations) + ": of its " +
                          std::to_string(data.sample_count()) + " samples the first " + std::to_string(orders.past()) +
                          " of each experiment are needed as the past");
}

}  // namespace

PolynomialEstimate arx(const IdData& data, const PolynomialOrders& orders) {
    orders.validate();
    if (orders.nc + orders.nd > 0 || std::any_of(orders.nf.begin(), orders.nf.end(), [](int nf) { return nf > 0; }))
        throw InvalidArgument("arx has the orders na, nb and nk only: nc, nd and nf must be zero");
    check_polynomial_data("arx", data, orders);
    const Regression regression(data, orders);
    const Index equations = regression.equations(), d = orders.parameter_count();
    check_arx(data, orders, equations);

    const Solution solution = solve(regression, orders, data);
    PolynomialEstimate estimate(orders, solution.theta, data.Ts);
    const Sums sums = sums_of_squares(data, regression, estimate);
    estimate.loss = sums.prediction_error / static_cast<double>(equations);
    estimate.noise_variance = sums.prediction_error / static_cast<double>(equations - d);
    estimate.covariance = estimate.noise_variance * solution.inverse_gram;
    estimate.std = estimate.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    estimate.condition_number = solution.condition_number;
    estimate.fit_percent = fit_percent_of_sums(sums.simulation_error, sums.variation);
    estimate.prediction_fit_percent = fit_percent_of_sums(sums.prediction_error, sums.variation);
    estimate.offsets = Vector::Zero(static_cast<Index>(data.experiments.size()));
    add_warnings(estimate);
    estimate.message = "Least squares over " + std::to_string(equations) + " equations: fit " +
                       number_text(estimate.prediction_fit_percent, 4) + " % predicting one step, " +
                       number_text(estimate.fit_percent, 4) + " % simulating from the recorded past.";
    for (const std::string& warning : estimate.warnings) estimate.message += ' ' + warning;
    return estimate;
}

}  // namespace dynlab
