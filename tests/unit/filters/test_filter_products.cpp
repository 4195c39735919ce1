#include "numerics/filters/filter_products.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numerics/filters/sensitivity_system.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/sampled_recursion.h"

namespace test_filter_products {

using namespace dynlab;

using Samples = Eigen::Map<const Vector>;

// Largest difference of two matrices of products, each entry relative to the norms of its two signals.
double difference(const Matrix& products, const Matrix& left, const Matrix& right) {
    const Matrix expected = left.transpose() * right;
    const Matrix scale = left.colwise().norm().transpose() * right.colwise().norm();
    return ((products - expected).array() / scale.array().max(1e-300)).abs().maxCoeff();
}

/// The outputs as they are defined, sample by sample.
Matrix outputs_of(const SampledSystem& system, const Vector& u) {
    SampledRecursion recursion(system, Samples(u.data(), u.size()));
    Matrix y(u.size(), recursion.output_count());
    Vector row(recursion.output_count());
    for (Index k = 0; k < u.size(); ++k) {
        recursion.output(k, row);
        y.row(k) = row.transpose();
        recursion.step(k);
    }
    return y;
}

Vector stable_denominator(Index order) {
    Vector den = Vector::Ones(1);
    for (Index i = 0; i + 1 < order; i += 2) den = multiply(den, Eigen::Vector3d(1, 1.2 + 0.3 * i, 4 + 5.0 * i));
    if (order % 2 == 1) den = multiply(den, Eigen::Vector2d(1, 0.7));
    return den;
}

struct ProductsCase {
    Index order, samples;
    double delay;
    Hold hold;
};

class filter_products_of : public testing::TestWithParam<ProductsCase> {};

// oracle: definition, the outputs of the recursion multiplied out
TEST_P(filter_products_of, outputs_equal_the_stored_ones_multiplied) {
    const auto [order, N, delay, hold] = GetParam();
    const double Ts = 0.05;
    const Vector y = RandomStream(1).normal(N), u = RandomStream(2).normal(N), den = stable_denominator(order);
    const SingleInputSystem cascade = sensitivity_system(Eigen::Vector2d(-2, 1).head(std::min<Index>(order, 2)), den);
    const SampledSystem of_y = derivative_filter(den, Ts, Hold::kFoh);
    const SampledSystem of_u = discretize(cascade.A, cascade.B, cascade.C, cascade.D, Ts, hold, delay);
    Matrix outputs(N, of_y.C.rows() + of_u.C.rows());
    outputs << outputs_of(of_y, y), outputs_of(of_u, u);
    const std::vector<FilteredSignal> signals{{of_y, Samples(y.data(), N)}, {of_u, Samples(u.data(), N)}};

    std::vector<Index> all(static_cast<std::size_t>(outputs.cols()));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_LT(difference(filter_products(signals, all, all), outputs, outputs), 1e-12);
    const std::vector<Index> left{order + 2, order + 3}, right{0, 1, order + 2};
    EXPECT_LT(difference(filter_products(signals, left, right), outputs(Eigen::all, left), outputs(Eigen::all, right)),
              1e-12);
}

INSTANTIATE_TEST_SUITE_P(data_sets, filter_products_of,
                         testing::Values(ProductsCase{1, 1, 0, Hold::kZoh}, ProductsCase{1, 2, 0, Hold::kFoh},
                                         ProductsCase{1, 17, 0, Hold::kZoh}, ProductsCase{2, 66, 0, Hold::kZoh},
                                         ProductsCase{2, 67, 0.05, Hold::kZoh}, ProductsCase{2, 1500, 0.37, Hold::kFoh},
                                         ProductsCase{2, 1500, 0.4, Hold::kFoh},
                                         ProductsCase{1, 1501, 0.37, Hold::kZoh},
                                         ProductsCase{2, 1502, 0.37, Hold::kZoh},
                                         ProductsCase{2, 100000, 0, Hold::kZoh}, ProductsCase{3, 999, 0.01, Hold::kZoh},
                                         ProductsCase{3, 999, 60, Hold::kZoh}, ProductsCase{4, 5000, 0, Hold::kFoh},
                                         ProductsCase{4, 5000, 1.23, Hold::kZoh}, ProductsCase{5, 3000, 0, Hold::kZoh},
                                         ProductsCase{6, 3000, 0.11, Hold::kFoh},
                                         ProductsCase{9, 3000, 0.11, Hold::kZoh}),
                         [](const auto& instance) {
                             const ProductsCase& c = instance.param;
                             return "order_" + std::to_string(c.order) + "_samples_" + std::to_string(c.samples) +
                                    "_delay_ms_" + std::to_string(static_cast<int>(1000 * c.delay + 0.5)) +
                                    (c.hold == Hold::kZoh ? "_zoh" : "_foh");
                         });

TEST(filter_products, undamped_filters_are_followed_exactly) {  // oracle: definition; nothing is ever forgotten here
    const Index N = 4001;
    const Vector u = RandomStream(3).normal(N);
    const SampledSystem system = derivative_filter(Eigen::Vector3d(1, 0, 1), 0.1, Hold::kZoh);
    const Matrix outputs = outputs_of(system, u);
    EXPECT_LT(difference(filter_products({{system, Samples(u.data(), N)}}, {0, 1, 2}, {0, 1, 2}), outputs, outputs),
              1e-11);
}

// oracle: definition; signals alone, one output, a signal as it is, a late sample
TEST(filter_products, signals_alone_and_single_outputs_equal_the_stored_ones_multiplied) {
    const Index N = 2003;
    const Vector y = RandomStream(1).normal(N), u = RandomStream(2).normal(N);
    SampledSystem itself = discrete_system(Matrix(0, 0), Vector(0), Matrix(1, 0), Vector::Ones(1), 0);
    for (const double delay : {0.0, 0.13})
        for (const Vector& den : {Vector(Eigen::Vector2d(1, 3)), Vector(Eigen::Vector3d(1, 6, 9)),
                                  Vector(Eigen::Vector3d(1, 0.4, 25)), Vector(Eigen::Vector3d(1, 50, 49))}) {
            SampledSystem system = derivative_filter(den, 0.02, Hold::kZoh, delay);
            system.C = system.C.bottomRows(1).eval();
            system.D = system.D.bottomRows(1).eval();
            system.first_D = system.first_D.tail(1).eval();
            Matrix outputs(N, 2);
            outputs << y, outputs_of(system, u);
            const FilteredSignal of_y{itself, Samples(y.data(), N)}, of_u{system, Samples(u.data(), N)};
            EXPECT_LT(difference(filter_products({of_y, of_u}, {0, 1}, {0, 1}), outputs, outputs), 1e-13);
            EXPECT_LT(difference(filter_products({of_u}, {0}, {0}), outputs.rightCols(1), outputs.rightCols(1)), 1e-13);
        }
}

// oracle: definition; next to nothing is left of a signal of alternating sign after a slow filter
TEST(filter_products, two_equal_poles_keep_the_digits_whatever_the_signal) {
    const Index N = 20011;
    const Vector u = RandomStream(2).normal(N), time = Vector::LinSpaced(N, 0, static_cast<double>(N - 1));
    const Vector sign = time.unaryExpr([](double k) { return std::fmod(k, 2) == 0 ? 1.0 : -1.0; });
    const std::vector<Vector> signals{RandomStream(1).normal(N),
                                      (0.001 * time).array().sin(),
                                      Vector::Ones(N),
                                      sign,
                                      sign.array() * (1e-4 * time).array().exp(),
                                      Vector::Zero(N)};
    for (const double pole : {0.5, 0.97, 0.9999, 0.9999999, 1.0, -0.9})
        for (const Vector& y : signals) {
            const Matrix A = (Matrix(2, 2) << pole, 0, 1, pole).finished();
            const Matrix C = Matrix::Identity(3, 2);
            const SampledSystem of_y = discrete_system(A, Vector::Unit(2, 0), C, Vector::Unit(3, 2), 0);
            const SampledSystem of_u =
                discrete_system(A, Vector::Unit(2, 0), Eigen::RowVector2d(1, 2), Vector::Zero(1), 0);
            Matrix outputs(N, 4);
            outputs << outputs_of(of_y, y), outputs_of(of_u, u);
            const Matrix products = filter_products({{of_y, Samples(y.data(), N)}, {of_u, Samples(u.data(), N)}},
                                                    {0, 1, 2, 3}, {0, 1, 2, 3});
            // A sum of N terms rounds by N epsilon at most; each step of q by what 1/(1 - pole) steps of p have left.
            const double steps = std::min(static_cast<double>(N), 1 / std::max(1e-12, 1 - std::abs(pole)));
            const double rounding = std::numeric_limits<double>::epsilon() * (static_cast<double>(N) + 4 * steps);
            EXPECT_LT(difference(products, outputs, outputs), rounding) << "pole " << pole << ", y " << y.head(3);
        }
}

}  // namespace test_filter_products
