#include <gtest/gtest.h>

#include "numerics/criteria/discrete_output.h"
#include "numerics/criteria/prediction_error_products.h"
#include "numerics/signals/random.h"

namespace test_prediction_error_products {

using namespace dynlab;

/// signal D/C over its rows, by the difference equation; rows before the nd-th are zero.
Vector filtered(const Vector& x, const Vector& C, const Vector& D) {
    const Index nd = D.size() - 1;
    Vector z = Vector::Zero(x.size());
    for (Index k = nd; k < x.size(); ++k) {
        for (Index i = 0; i <= nd; ++i) z[k] += D[i] * x[k - i];
        for (Index j = 1; j < C.size() && j <= k; ++j) z[k] -= C[j] * z[k - j];
    }
    return z;
}

Vector late(const Vector& x, Index lag, Index silent) {
    Vector y = Vector::Zero(x.size());
    for (Index k = std::max(lag, silent); k < x.size(); ++k) y[k] = x[k - lag];
    return y;
}

Vector rows_of(const LateColumn& column, Index first, Index rows) {
    Vector x(rows);
    for (Index r = 0; r < rows; ++r) {
        const Index k = first + r - column.late;
        x[r] = column.constant + (k >= 0 ? column.weight * column.signal[k] : 0);
    }
    return x;
}

/// Every column written out.
Matrix by_definition(const std::vector<LateColumn>& columns, const LateColumn& error, Index first, Index rows,
                     const Vector& C, const Vector& D) {
    const Index nc = C.size() - 1, nd = D.size() - 1;
    const Vector one = Vector::Ones(1), w = rows_of(error, first, rows), e = filtered(w, C, D);
    std::vector<Vector> all;
    for (const LateColumn& column : columns) all.push_back(filtered(rows_of(column, first, rows), C, D));
    all.push_back(e);
    for (Index j = 1; j <= nc; ++j) all.push_back(filtered(late(e, j, nd), C, one));
    for (Index i = 1; i <= nd; ++i) all.push_back(filtered(-late(w, i, nd), C, one));
    Matrix M(rows, static_cast<Index>(all.size()));
    for (std::size_t c = 0; c < all.size(); ++c) M.col(static_cast<Index>(c)) = all[c];
    return M.transpose() * M;
}

TEST(prediction_error_products, equal_the_products_of_the_columns_written_out) {  // oracle: the definition
    RandomStream random(2);
    const std::vector<std::pair<Vector, Vector>> noises = {{Vector{{1.0}}, Vector{{1.0}}},
                                                           {Vector{{1.0, 0.9}}, Vector{{1.0, -1.0, 0.2}}},
                                                           {Vector{{1.0, -0.3, 0.1, 0.4}}, Vector{{1.0}}},
                                                           {Vector{{1.0}}, Vector{{1.0, 0.5, 0.3, -0.2}}}};
    for (const Index rows : {1, 2, 5, 256, 257, 1200}) {
        const Vector y = random.normal(rows + 7), u = random.normal(rows + 7), w = random.normal(rows + 7);
        std::vector<LateColumn> few = {{y, 1, -1, 0}, {u, 9, 2, 0.5}, {u, 300, 1, 0.25}}, many = few;
        for (Index i = 0; i < 9; ++i) many.push_back({u, i, 1 + 0.1 * static_cast<double>(i), 0});
        for (const auto& [C, D] : noises)
            for (const std::vector<LateColumn>& columns : {std::vector<LateColumn>(), few, many}) {
                const Matrix expected = by_definition(columns, {w, 0, 1, 0}, 7, rows, C, D);
                const Matrix products = prediction_error_products(columns, {w, 0, 1, 0}, 7, rows, C, D);
                ASSERT_EQ(products.rows(), expected.rows());
                EXPECT_LT((products - expected).cwiseAbs().maxCoeff(), 1e-11 * (1 + expected.cwiseAbs().maxCoeff()));
            }
    }
}

TEST(prediction_error_products, go_to_the_places_of_their_parameters) {  // oracle: the definition
    OutputErrorProducts sums{1, Matrix::Zero(3, 3), Vector::Zero(3)};
    const Matrix products{{4.0, 5.0, 6.0}, {5.0, 7.0, 8.0}, {6.0, 8.0, 9.0}};
    add_to(sums, products, {2, -1, 0});
    EXPECT_EQ(sums.squares, 8);
    EXPECT_EQ(sums.descent, (Vector{{8.0, 0.0, 5.0}}));
    EXPECT_EQ(sums.gram, (Matrix{{9.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {6.0, 0.0, 4.0}}));
}

/// Oracle: the second route, the stored sensitivities.
void expect_same_as_simulated(const OutputErrorModel& model, const Vector& theta, const Vector& y) {
    const OutputErrorProducts fast = model.products(theta, y), plain = model.OutputErrorModel::products(theta, y);
    EXPECT_NEAR(fast.squares, plain.squares, 1e-11 * plain.squares);
    const Vector size = plain.gram.diagonal().cwiseSqrt();
    for (Index i = 0; i < theta.size(); ++i) {
        EXPECT_NEAR(fast.descent[i], plain.descent[i], 1e-10 * size[i] * std::sqrt(plain.squares)) << i;
        for (Index j = 0; j < theta.size(); ++j)
            EXPECT_NEAR(fast.gram(i, j), plain.gram(i, j), 1e-10 * size[i] * size[j]) << i << ' ' << j;
    }
}

TEST(prediction_error_products, of_a_discrete_model_are_those_of_its_sensitivities) {
    RandomStream random(4);
    std::vector<SampledExperiment> experiments;
    for (const Index N : {400, 900}) {
        Matrix u(N, 2);
        u << random.normal(N), random.normal(N);
        u.row(0).array() += 3;
        experiments.push_back({u, random.normal(N)});
    }
    const PolynomialOrders orders = PolynomialOrders::output_error({2, 3}, {2, 1}, {1, 3});
    for (const InitialState state : {InitialState::kZero, InitialState::kSteady, InitialState::kEstimate})
        for (const bool offset : {false, true}) {
            const DiscreteOutput model(orders, {state, offset}, experiments);
            Vector theta = 0.3 * random.normal(model.parameter_count());
            theta = model.with_stable_poles(theta);
            expect_same_as_simulated(model, theta, model.target());
        }
}

}  // namespace test_prediction_error_products
