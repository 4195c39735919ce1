#include "numerics/criteria/arx_equations.h"

#include <cmath>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/triangular_factor.h"
#include "numerics/signals/lagged_gram.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kGramLimit = 1e3;  // beyond this condition number the Gram matrix costs digits

}  // namespace

ArxSolution solve_gram(const MatrixView& gram) {
    const Index d = gram.cols() - 1;
    Vector unscale = gram.diagonal().head(d).cwiseSqrt();
    for (double& value : unscale) value = value > 0 ? 1 / value : 1;
    const Matrix scaled = unscale.asDiagonal() * gram.topLeftCorner(d, d) * unscale.asDiagonal();
    const auto [values, vectors] = symmetric_eigen(scaled);
    ArxSolution solution;
    solution.condition_number = std::sqrt(values[d - 1] / std::max(values[0], 1e-300));
    const Matrix V = unscale.asDiagonal() * vectors;
    solution.inverse_gram = V * values.cwiseInverse().asDiagonal() * V.transpose();
    solution.theta = unscale.asDiagonal() * solve_semidefinite(scaled, unscale.asDiagonal() * gram.col(d).head(d));
    return solution;
}

Index ArxEquations::count() const {
    Index count = 0;
    for (const Experiment& experiment : data_.experiments)
        count += std::max<Index>(0, experiment.y.rows() - orders_.past());
    return count;
}

void ArxEquations::fill(const Experiment& experiment, Index k, Index rows, Matrix& block) const {
    Index column = 0;
    for (int i = 1; i <= orders_.na; ++i) block.col(column++).head(rows) = -experiment.y.col(0).segment(k - i, rows);
    for (std::size_t input = 0; input < orders_.inputs(); ++input)
        for (int j = 0; j < orders_.nb[input]; ++j)
            block.col(column++).head(rows) =
                experiment.u.col(static_cast<Index>(input)).segment(k - orders_.nk[input] - j, rows);
    block.col(column).head(rows) = experiment.y.col(0).segment(k, rows);
}

Matrix ArxEquations::gram() const {
    const Index d = parameters();
    Matrix gram = Matrix::Zero(d + 1, d + 1);
    for (const Experiment& experiment : data_.experiments) {
        std::vector<LaggedColumns> columns{{experiment.y.col(0), 1, orders_.na, -1}};
        for (std::size_t input = 0; input < orders_.inputs(); ++input)
            columns.push_back({experiment.u.col(static_cast<Index>(input)), orders_.nk[input], orders_.nb[input], 1});
        columns.push_back({experiment.y.col(0), 0, 1, 1});
        gram += lagged_gram(columns, orders_.past(), experiment.y.rows() - orders_.past());
    }
    return gram;
}

ArxEquations::InstrumentProducts ArxEquations::products(const ArxEquations& instruments) const {
    const Index d = parameters();
    InstrumentProducts products{Matrix::Zero(d, d + 1), Matrix::Zero(d, d)};
    Matrix equations(kBlock, d + 1), others(kBlock, d + 1);
    for (std::size_t e = 0; e < data_.experiments.size(); ++e) {
        const Experiment &own = data_.experiments[e], &other = instruments.data_.experiments[e];
        for (Index k = orders_.past(); k < own.y.rows(); k += kBlock) {
            const Index rows = std::min(kBlock, own.y.rows() - k);
            fill(own, k, rows, equations);
            instruments.fill(other, k, rows, others);
            const auto Z = others.topLeftCorner(rows, d);
            products.with_equations.noalias() += Z.transpose() * equations.topRows(rows);
            products.gram.noalias() += Z.transpose() * Z;
        }
    }
    return products;
}

Matrix ArxEquations::triangular_factor() const {
    TriangularFactor factor(parameters() + 1);
    for_each_block([&](const auto& block) { factor.add(block); });
    return factor.R();
}

std::vector<Vector> ArxEquations::errors(const VectorView& theta) const {
    const Index d = parameters();
    std::vector<Vector> errors;
    for (const Experiment& experiment : data_.experiments)
        errors.emplace_back(std::max<Index>(0, experiment.y.rows() - orders_.past()));
    Index place = 0;
    std::size_t e = 0;
    for_each_block([&](const auto& block) {
        while (place == errors[e].size()) {
            place = 0;
            ++e;
        }
        errors[e].segment(place, block.rows()) = block.col(d) - block.leftCols(d) * theta;
        place += block.rows();
    });
    return errors;
}

ArxSolution solve_arx(const ArxEquations& equations) {
    ArxSolution quick = solve_gram(equations.gram());
    if (quick.condition_number < kGramLimit) return quick;
    const Index d = equations.parameters();
    const Matrix R = equations.triangular_factor();
    const LeastSquares fit = solve_least_squares(R.leftCols(d), R.col(d));
    return {fit.solution, fit.inverse_gram, fit.condition_number};
}

Vector free_run(const VectorView& a, const VectorView& driven, const VectorView& y, Index known) {
    Vector output = y;
    for (Index k = std::min(known, output.size()); k < output.size(); ++k) {
        double value = driven[k];
        for (Index i = 1; i <= std::min(a.size(), k); ++i) value -= a[i - 1] * output[k - i];
        output[k] = value;
    }
    return output;
}

Vector driven_part(const PolynomialModel& model, const MatrixView& u) {
    Vector sum = Vector::Zero(u.rows());
    for (std::size_t input = 0; input < model.B.size(); ++input) {
        const Vector& B = model.B[input];
        for (Index j = 0; j < std::min(B.size(), u.rows()); ++j)
            if (B[j] != 0) sum.tail(u.rows() - j) += B[j] * u.col(static_cast<Index>(input)).head(u.rows() - j);
    }
    return sum;
}

}  // namespace dynlab::inline numerics
