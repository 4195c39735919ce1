#include <gtest/gtest.h>

#include "numerics/filters/normal_equations.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_normal_equations {

using namespace dynlab;

constexpr double kTs = 0.1;
constexpr Index kSamples = 700;

struct Kind {
    const char* name;
    Vector A;  ///< monic
    std::vector<Vector> B;
    std::vector<double> delays;  ///< s
};

void PrintTo(const Kind& kind, std::ostream* out) {
    *out << kind.name;
}

/// p^power as a numerator.
Vector differentiator(Index power) {
    return Vector::Unit(power + 1, 0);
}

class normal_equations : public testing::TestWithParam<Kind> {
  protected:
    Vector y_ = RandomStream(1).normal(kSamples);
    std::vector<Vector> u_;
    RegressionData data_set_{SampleView(y_.data(), kSamples), {}, {}, {}, {kTs}};

    void SetUp() override {
        const Kind& kind = GetParam();
        for (std::size_t j = 0; j < kind.B.size(); ++j)
            u_.push_back(RandomStream(2 + static_cast<std::uint32_t>(j)).normal(kSamples));
        for (std::size_t j = 0; j < kind.B.size(); ++j) {
            data_set_.u.emplace_back(u_[j].data(), kSamples);
            data_set_.zeros.push_back(static_cast<int>(kind.B[j].size()) - 1);
        }
        data_set_.delays = kind.delays;
    }

    Index order() const { return GetParam().A.size() - 1; }

    /// num/den u_j(t - delay_j), the input held.
    Vector driven(std::size_t j, const Vector& num, const Vector& den) const {
        return lsim(TransferFunction(num, den).with_delay(GetParam().delays[j]), u_[j], kTs);
    }

    /// phi of the header, signals filtered by gain/den, one row a sample.
    Matrix regressors(const Vector& den, double gain) const {
        const Index n = order();
        std::vector<Vector> columns;
        for (Index i = 1; i <= n; ++i)
            columns.push_back(-lsim(TransferFunction(gain * differentiator(n - i), den), y_, kTs, Hold::kFoh));
        for (std::size_t j = 0; j < u_.size(); ++j)
            for (Index power = data_set_.zeros[j]; power >= 0; --power)
                columns.push_back(driven(j, gain * differentiator(power), den));
        Matrix phi(kSamples, static_cast<Index>(columns.size()));
        for (Index c = 0; c < phi.cols(); ++c) phi.col(c) = columns[static_cast<std::size_t>(c)];
        return phi;
    }
    Vector highest(const Vector& den, double gain) const {
        return lsim(TransferFunction(gain * differentiator(order()), den), y_, kTs, Hold::kFoh);
    }
};

/// Whether two sums over the same samples agree, each number against the size of the largest.
void expect_near(const Matrix& found, const Matrix& expected) {
    ASSERT_EQ(found.rows(), expected.rows());
    ASSERT_EQ(found.cols(), expected.cols());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
}

// Oracle: every filtered signal simulated separately, and the products summed.
TEST_P(normal_equations, of_state_variable_filters) {
    Vector E = Vector::Ones(1);
    for (Index i = 0; i < order(); ++i) E = multiply(E, Vector{{1, 3}});
    const double gain = E[E.size() - 1];
    const NormalEquations sums = svf_equations(data_set_, E, gain);
    const Matrix phi = regressors(E, gain);
    const Vector left = highest(E, gain);
    expect_near(sums.z_phi, phi.transpose() * phi);
    expect_near(sums.z_y, phi.transpose() * left);
    EXPECT_NEAR(sums.y_y, left.squaredNorm(), 1e-8 * left.squaredNorm());
}

TEST_P(normal_equations, of_the_refined_instruments) {
    const auto& [name, A, B, delays] = GetParam();
    const NormalEquations sums = refined_equations(data_set_, A, B, true);
    const Matrix phi = regressors(A, 1);
    Matrix z = phi;
    const Vector squared = multiply(A, A);
    for (Index i = 1; i <= order(); ++i) {
        z.col(i - 1).setZero();
        for (std::size_t j = 0; j < B.size(); ++j)
            z.col(i - 1) -= driven(j, multiply(B[j], differentiator(order() - i)), squared);
    }
    expect_near(sums.z_phi, z.transpose() * phi);
    expect_near(sums.z_y, z.transpose() * highest(A, 1));
    expect_near(sums.z_z, z.transpose() * z);
}

TEST_P(normal_equations, of_output_errors) {
    const auto& [name, A, B, delays] = GetParam();
    Vector e = y_;
    for (std::size_t j = 0; j < B.size(); ++j) e -= driven(j, B[j], A);
    const double squares = output_error_squares(data_set_, std::vector<Vector>(B.size(), A), B);
    EXPECT_NEAR(squares, e.squaredNorm(), 1e-9 * e.squaredNorm());
}

INSTANTIATE_TEST_SUITE_P(
    all_tiers, normal_equations,
    testing::Values(Kind{"one_pole", Vector{{1, 2}}, {Vector{{3}}}, {0}},
                    Kind{"one_pole_delayed", Vector{{1, 2}}, {Vector{{3}}}, {0.34}},
                    Kind{"two_poles", Vector{{1, 2, 5}}, {Vector{{1, 5}}}, {0}},
                    Kind{"two_poles_delayed_by_samples", Vector{{1, 2, 5}}, {Vector{{1, 5}}}, {0.3}},
                    Kind{"two_poles_delayed_between_samples", Vector{{1, 2, 5}}, {Vector{{5}}}, {0.34}},
                    Kind{"two_inputs", Vector{{1, 2, 5}}, {Vector{{1, 5}}, Vector{{2}}}, {0, 0.27}},
                    Kind{"three_poles", Vector{{1, 4, 9, 10}}, {Vector{{2, 10}}}, {0.12}},
                    Kind{"four_poles", Vector{{1, 6, 17, 28, 20}}, {Vector{{1, 3, 20}}}, {0}},
                    Kind{"five_poles", Vector{{1, 8, 29, 62, 76, 40}}, {Vector{{40}}}, {0.12}}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace test_normal_equations
