#include "numerics/filters/delta_regression.h"
#include "numerics/filters/filter_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"

namespace test_delta_regression {

using namespace dynlab;

constexpr double kTs = 0.01;

SampleView view(const Vector& x) {
    return {x.data(), x.size()};
}

/// p^highest/A .. 1/A of a signal, N x (highest + 1).
Matrix derivatives(const SampleView& signal, const Vector& A, Index highest, Hold hold, double delay) {
    return chain_outputs({signal, derivatives_filter(A, highest), hold, delay}, {kTs, {nullptr, 0}});
}

/// -p^(n-i) B/A^2 of a signal, N x n, p^(n-i) B/A^2 = p^(n-i+m-j) b_j/A^2.
Matrix sensitivities(const SampleView& signal, const Vector& A, const Vector& B, Hold hold, double delay) {
    const Index n = A.size() - 1, m = B.size() - 1;
    const Matrix of_w = derivatives(signal, multiply(A, A), n - 1 + m, hold, delay);
    Matrix z = Matrix::Zero(signal.size(), n);
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j <= m; ++j) z.col(i) -= B[j] * of_w.col(i + j);
    return z;
}

/// p^(n-1)/E .. 1/E of the simulated output of B/A.
Matrix filtered_simulation(const SampleView& signal, const Vector& E, const Vector& A, const Vector& B, Hold hold_y,
                           double delay) {
    FilterChain chain{signal, derivatives_filter(E, E.size() - 2), hold_y};
    chain.front = FrontModel{transfer_system(B, A), Hold::kZoh, delay};
    return chain_outputs(chain, {kTs, {nullptr, 0}});
}

struct Model {
    const char* name;
    Vector A;
    double rounding;  ///< of the products of signals that are filtered twice, relative to the signals' norms
    Index samples = 1503;
};

void PrintTo(const Model& model, std::ostream* out) {
    *out << model.name;
}

class delta_regression : public testing::TestWithParam<Model> {
  protected:
    delta_regression()
        : y_(RandomStream(3).normal(model_.samples)),
          u_(RandomStream(4).normal(model_.samples)),
          v_(RandomStream(5).normal(model_.samples)) {
        for (Index k = 0; k < model_.samples; ++k) {  // slow parts as well, for what a filter forgets late
            y_[k] += 2 * std::sin(0.01 * static_cast<double>(k)) + 1;
            u_[k] += k < model_.samples / 2 ? 1.5 : -0.5;
        }
    }
    /// Every hold, delay and degree of the numerator, with one and two inputs.
    template <class Function>
    void for_all(const Function& f) const {
        const int n = static_cast<int>(model_.A.size()) - 1;
        for (const Hold hold : {Hold::kZoh, Hold::kFoh})
            for (const Hold hold_y : {Hold::kZoh, Hold::kFoh})
                for (const double delay : {0.0, 0.03, 0.034, 2.413})
                    for (int m = 0; m <= n; ++m)
                        for (int inputs = 1; inputs <= 2; ++inputs) {
                            SCOPED_TRACE(std::string("input ") + (hold == Hold::kZoh ? "zoh" : "foh") + ", output " +
                                         (hold_y == Hold::kZoh ? "zoh" : "foh") + ", delay " + std::to_string(delay) +
                                         " s, " + std::to_string(m) + " zeros, " + std::to_string(inputs) + " inputs");
                            RegressionData data_set{view(y_), {view(u_)}, {m}, {delay}, {kTs}, hold, hold_y};
                            std::vector<Vector> B{Vector::LinSpaced(m + 1, 0.7, 2)};
                            if (inputs == 2) {
                                data_set.u.push_back(view(v_));
                                data_set.zeros.push_back(0);
                                data_set.delays.push_back(0.02);
                                B.push_back(Vector::Ones(1));
                            }
                            f(data_set, B);
                        }
    }
    /// [phi, p^n y_f] with signals filtered by 1/A.
    static Matrix regressors(const RegressionData& data_set, const Vector& A) {
        const Index n = A.size() - 1;
        const Matrix of_y = derivatives(data_set.y, A, n, data_set.hold_y, 0);
        Matrix phi = -of_y.rightCols(n);
        for (std::size_t j = 0; j < data_set.u.size(); ++j)
            append(phi, derivatives(data_set.u[j], A, data_set.zeros[j], data_set.hold, data_set.delays[j]));
        append(phi, of_y.leftCols(1));
        return phi;
    }
    static void append(Matrix& columns, const Matrix& more) {
        Matrix joined(more.rows(), columns.cols() + more.cols());
        joined << columns, more;
        columns = std::move(joined);
    }
    /// Largest difference from the products of these signals, relative to their norms.
    static double difference(const Matrix& sums, const Matrix& left, const Matrix& right) {
        const Matrix scale = left.colwise().norm().transpose() * right.colwise().norm();
        return ((sums - left.transpose() * right).array() / scale.array().max(1e-300)).abs().maxCoeff();
    }
    static void expect_sums(const NormalEquations& sums, const Matrix& z, const Matrix& phi, double rounding) {
        const Index d = z.cols();
        EXPECT_LT(difference(sums.z_phi, z, phi.leftCols(d)), rounding);
        EXPECT_LT(difference(sums.z_y, z, phi.rightCols(1)), rounding);
        EXPECT_LT(difference(sums.z_z, z, z), rounding);
    }

    const Model& model_ = GetParam();
    Vector y_, u_, v_;
};

// oracle of all: second route, every filtered signal stored by ExactFilter and multiplied out

TEST_P(delta_regression, svf_sums_are_those_of_stored_signals) {
    for_all([&](const RegressionData& data_set, const std::vector<Vector>&) {
        const auto sums = delta_svf_equations(data_set, model_.A, 1);
        ASSERT_TRUE(sums);
        const Matrix phi = regressors(data_set, model_.A);
        expect_sums(*sums, phi.leftCols(phi.cols() - 1), phi, 1e-11);
        EXPECT_NEAR(sums->y_y / phi.rightCols(1).squaredNorm(), 1, 1e-11);
        const auto scaled = delta_svf_equations(data_set, model_.A, 3);
        ASSERT_TRUE(scaled);
        EXPECT_NEAR(scaled->y_y / sums->y_y, 9, 1e-14 * 9);
    });
}

TEST_P(delta_regression, refined_sums_are_those_of_stored_signals) {
    for_all([&](const RegressionData& data_set, const std::vector<Vector>& B) {
        const auto sums = delta_refined_equations(data_set, model_.A, B, true);
        ASSERT_TRUE(sums);
        const Index n = model_.A.size() - 1;
        const Matrix phi = regressors(data_set, model_.A);
        Matrix z = phi.leftCols(phi.cols() - 1);
        z.leftCols(n).setZero();
        for (std::size_t j = 0; j < B.size(); ++j)
            z.leftCols(n) += sensitivities(data_set.u[j], model_.A, B[j], data_set.hold, data_set.delays[j]);
        expect_sums(*sums, z, phi, model_.rounding);
        const auto without_gram = delta_refined_equations(data_set, model_.A, B, false);
        ASSERT_TRUE(without_gram);
        EXPECT_EQ(without_gram->z_z.size(), 0);
        EXPECT_EQ(without_gram->z_phi, sums->z_phi);
    });
}

TEST_P(delta_regression, auxiliary_sums_are_those_of_stored_signals) {
    const Index n = model_.A.size() - 1;
    const Vector E = power(Eigen::Vector2d(1, 2.5), static_cast<int>(n));
    for_all([&](const RegressionData& data_set, const std::vector<Vector>& B) {
        const auto sums = delta_auxiliary_equations(data_set, E, model_.A, B, 1);
        ASSERT_EQ(sums.has_value(), data_set.hold == Hold::kZoh && B[0].size() <= n);
        if (!sums) return;
        const Matrix phi = regressors(data_set, E);
        Matrix z = phi.leftCols(phi.cols() - 1);
        z.leftCols(n).setZero();
        for (std::size_t j = 0; j < B.size(); ++j)
            z.leftCols(n) -= filtered_simulation(data_set.u[j], E, model_.A, B[j], data_set.hold_y, data_set.delays[j]);
        expect_sums(*sums, z, phi, 1e-10);
    });
}

TEST_P(delta_regression, output_sums_are_those_of_stored_signals) {
    for_all([&](const RegressionData& data_set, const std::vector<Vector>& B) {
        const std::vector<Vector> A(B.size(), model_.A);
        const auto sums = delta_output_products(data_set, A, B);
        ASSERT_TRUE(sums);
        Matrix signals = data_set.y;
        for (std::size_t j = 0; j < B.size(); ++j)
            append(signals,
                   chain_outputs({data_set.u[j], transfer_system(B[j], A[j]), data_set.hold, data_set.delays[j]},
                                 {kTs, {nullptr, 0}}));
        EXPECT_LT(difference(*sums, signals, signals), 1e-12);
    });
}

INSTANTIATE_TEST_SUITE_P(of, delta_regression,
                         testing::Values(Model{"one_pole", Eigen::Vector2d(1, 3), 1e-11},
                                         Model{"two_poles", Eigen::Vector3d(1, 4, 3), 1e-11},
                                         Model{"two_resonant_poles", Eigen::Vector3d(1, 0.6, 40), 1e-11},
                                         Model{"two_equal_poles", Eigen::Vector3d(1, 6, 9), 1e-11, 1496},
                                         Model{"two_nearly_equal_poles", Eigen::Vector3d(1, 6, 9 - 1e-12), 1e-11, 1499},
                                         Model{"two_far_poles", Eigen::Vector3d(1, 40.01, 0.4), 1e-11, 1501},
                                         Model{"an_integrator", Eigen::Vector3d(1, 2, 0), 1e-11, 700},
                                         Model{"two_poles_for_few_samples", Eigen::Vector3d(1, 4, 3), 1e-11, 71},
                                         Model{"two_poles_for_long", Eigen::Vector3d(1, 20, 325), 2.3e-11, 40'007},
                                         Model{"three_poles", Eigen::Vector4d(1, 6, 11, 6), 1e-9},
                                         Model{"three_equal_poles", Eigen::Vector4d(1, 9, 27, 27), 1e-9},
                                         Model{"three_fast_poles", Eigen::Vector4d(1, 120, 12000, 400000), 1e-9},
                                         Model{"four_poles", (Vector(5) << 1, 10, 35, 50, 24).finished(), 1e-9},
                                         // Poles of 2 rad/s and 20 rad/s, damped by 0.1 and 0.25 (Rao and Garnier).
                                         Model{"four_resonant_poles", (Vector(5) << 1, 10.4, 408, 416, 1600).finished(),
                                               1e-9}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// oracle: signals stored by ExactFilter and multiplied out, of which almost nothing passes the filter. (There, a
// derivative is a difference of states that are larger by 1/(lambda Ts)^2 = 1e8.)
TEST(delta_regression_limits, a_signal_that_the_filter_stops_keeps_its_digits) {
    const Index N = 20'011;
    const Eigen::Vector3d A(1, 0.02, 1e-4);
    Vector y(N);
    for (Index k = 0; k < N; ++k) y[k] = k % 2 == 0 ? 1 : -1;
    const Vector u = RandomStream(4).normal(N);
    for (const Hold hold_y : {Hold::kZoh, Hold::kFoh}) {
        const auto sums = delta_svf_equations({view(y), {view(u)}, {0}, {0}, {kTs}, Hold::kZoh, hold_y}, A, 1);
        ASSERT_TRUE(sums);
        Matrix phi(N, 3);
        const Matrix of_y = derivatives(view(y), A, 2, hold_y, 0);
        phi << -of_y.rightCols(2), derivatives(view(u), A, 0, Hold::kZoh, 0);
        const Vector norms = phi.colwise().norm();
        const double norm = of_y.col(0).norm();
        EXPECT_LT(
            ((sums->z_phi - phi.transpose() * phi).array() / (norms * norms.transpose()).array()).abs().maxCoeff(),
            1e-5);
        EXPECT_LT(((sums->z_y - phi.transpose() * of_y.col(0)).array() / (norms * norm).array()).abs().maxCoeff(),
                  1e-5);
        EXPECT_NEAR(sums->y_y / (norm * norm), 1, 1e-5);
    }
}

TEST(delta_regression_limits, other_kinds_are_left_to_the_general_way) {
    const Vector y = RandomStream(1).normal(1000), u = RandomStream(2).normal(1000);
    const RegressionData data_set{view(y), {view(u)}, {0}, {0}, {kTs}};
    const std::vector<Vector> B{Vector::Ones(1)};
    const auto made = [&](const RegressionData& of, const Vector& A) {
        const bool refined = delta_refined_equations(of, A, B, false).has_value();
        EXPECT_EQ(delta_svf_equations(of, A, 1).has_value(), refined);
        EXPECT_EQ(delta_auxiliary_equations(of, A, A, B, 1).has_value(), refined);
        EXPECT_EQ(delta_output_products(of, {A}, B).has_value(), refined);
        return refined;
    };
    EXPECT_TRUE(made(data_set, Eigen::Vector3d(1, 4, 3)));
    EXPECT_FALSE(made(data_set, power(Eigen::Vector2d(1, 3), 5))) << "five poles";
    EXPECT_FALSE(made(data_set, Eigen::Vector3d(1, std::nan(""), 3))) << "not finite";
    const Vector t = Vector::LinSpaced(1000, 0, 9.99);
    const RegressionData irregular{view(y), {view(u)}, {0}, {0}, {0, view(t)}};
    EXPECT_FALSE(made(irregular, Eigen::Vector3d(1, 4, 3))) << "irregular";
    const RegressionData brief{SampleView(y.data(), 15), {SampleView(u.data(), 15)}, {0}, {0}, {kTs}};
    EXPECT_FALSE(made(brief, Eigen::Vector3d(1, 4, 3))) << "few samples";
    // Each pole twice, and three decades apart: only the sensitivities would suffer.
    const Vector far = multiply(Eigen::Vector3d(1, 4.4, 1.6), Eigen::Vector3d(1, 440, 16000));
    EXPECT_FALSE(delta_refined_equations(data_set, far, B, false));
    EXPECT_TRUE(delta_svf_equations(data_set, far, 1));
}

}  // namespace test_delta_regression
