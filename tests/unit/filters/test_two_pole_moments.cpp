#include "numerics/filters/two_pole_moments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/filters/lanes.h"
#include "numerics/filters/regression_moments.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"

namespace test_two_pole_moments {

using namespace dynlab;

SampleView view(const Vector& x) {
    return {x.data(), x.size()};
}

struct Signals {
    Vector y, u, zero;

    explicit Signals(Index N) : y(RandomStream(3).normal(N)), u(RandomStream(4).normal(N)), zero(Vector::Zero(N)) {
        // Slow parts as well, for what a filter forgets late.
        for (Index k = 0; k < N; ++k) {
            y[k] += 2 * std::sin(0.01 * static_cast<double>(k)) + 1;
            u[k] += k < N / 2 ? 1.5 : -0.5;
        }
    }
    RegressionRecord record(int zeros, double Ts, Hold hold, Hold hold_y) const {
        return {view(y), {view(u)}, {zeros}, {0}, {Ts}, hold, hold_y};
    }
    /// The same with an input that does nothing, which the general way is needed for.
    RegressionRecord with_idle_input(int zeros, double Ts, Hold hold, Hold hold_y) const {
        return {view(y), {view(u), view(zero)}, {zeros, 0}, {0, 0}, {Ts}, hold, hold_y};
    }
};

struct Kind {
    const char* name;
    Vector A;
    double Ts;
    Index samples;
    double rounding = 1e-12;  ///< N epsilon for a sum of N terms, and some for the filters
};

void PrintTo(const Kind& kind, std::ostream* out) {
    *out << kind.name;
}

/// Largest difference of two matrices of sums, relative to the sizes of what was multiplied.
double difference(const Matrix& sums, const Matrix& expected, const Vector& left, const Vector& right) {
    return ((sums - expected).array() / (left * right.transpose()).array()).abs().maxCoeff();
}

/// oracle: second route, the general way, which a further input of zeros leads to
void expect_svf_moments(const Signals& signals, int zeros, double Ts, Hold hold, Hold hold_y, const Vector& E,
                        double rounding) {
    const Index d = zeros + 3;
    const auto sums = two_pole_svf_moments(signals.record(zeros, Ts, hold, hold_y), E, 1.5);
    ASSERT_TRUE(sums);
    const RegressionMoments expected = svf_moments(signals.with_idle_input(zeros, Ts, hold, hold_y), E, 1.5);
    const Vector size = expected.z_phi.diagonal().head(d).cwiseSqrt();
    const Vector last = Vector::Constant(1, std::sqrt(expected.y_y));
    EXPECT_LT(difference(sums->z_phi, expected.z_phi.topLeftCorner(d, d), size, size), rounding);
    EXPECT_LT(difference(sums->z_z, expected.z_z.topLeftCorner(d, d), size, size), rounding);
    EXPECT_LT(difference(sums->z_y, expected.z_y.head(d), size, last), rounding);
    EXPECT_NEAR(sums->y_y / expected.y_y, 1, rounding);
}

class two_pole_moments : public testing::TestWithParam<Kind> {
  protected:
    /// Every numerator and hold.
    template <class Function>
    void for_all(const Function& f) const {
        for (const int zeros : {0, 1})
            for (const Hold hold : {Hold::kZoh, Hold::kFoh})
                for (const Hold hold_y : {Hold::kZoh, Hold::kFoh}) {
                    SCOPED_TRACE(std::to_string(zeros) + " zeros, input " + (hold == Hold::kZoh ? "zoh" : "foh") +
                                 ", output " + (hold_y == Hold::kZoh ? "zoh" : "foh"));
                    f(zeros, hold, hold_y);
                }
    }
    Vector numerator(int zeros) const {
        return zeros == 0 ? Vector::Constant(1, 2.5) : Vector(Eigen::Vector2d(0.7, 2));
    }

    const Kind& kind = GetParam();
    const Signals signals{kind.samples};
};

TEST_P(two_pole_moments, svf_agrees_with_the_general_way) {
    for_all([&](int zeros, Hold hold, Hold hold_y) {
        expect_svf_moments(signals, zeros, kind.Ts, hold, hold_y, kind.A, kind.rounding);
    });
}

TEST_P(two_pole_moments, refined_ones_agree_with_the_general_way) {
    for_all([&](int zeros, Hold hold, Hold hold_y) {
        const Index d = zeros + 3;
        const Vector B = numerator(zeros);
        const RegressionRecord record = signals.record(zeros, kind.Ts, hold, hold_y);
        const auto sums = two_pole_refined_moments(record, kind.A, B, true);
        ASSERT_TRUE(sums);
        const RegressionRecord general = signals.with_idle_input(zeros, kind.Ts, hold, hold_y);
        const RegressionMoments expected = refined_moments(general, kind.A, {B, Vector::Ones(1)}, true);
        const RegressionMoments of_phi = svf_moments(general, kind.A);
        const Vector z = expected.z_z.diagonal().head(d).cwiseSqrt(), phi = of_phi.z_phi.diagonal().head(d).cwiseSqrt();
        EXPECT_LT(difference(sums->z_phi, expected.z_phi.topLeftCorner(d, d), z, phi), kind.rounding);
        EXPECT_LT(difference(sums->z_y, expected.z_y.head(d), z, Vector::Constant(1, std::sqrt(of_phi.y_y))),
                  kind.rounding);
        EXPECT_LT(difference(sums->z_z, expected.z_z.topLeftCorner(d, d), z, z), kind.rounding);
        const auto without_gram = two_pole_refined_moments(record, kind.A, B, false);
        ASSERT_TRUE(without_gram);
        EXPECT_LT(difference(without_gram->z_phi, sums->z_phi, z, phi), kind.rounding);
        EXPECT_EQ(without_gram->z_z.size(), 0);
    });
}

TEST_P(two_pole_moments, auxiliary_ones_agree_with_the_general_way) {
    const Eigen::Vector3d E(1, 5, 6.25);
    for_all([&](int zeros, Hold hold, Hold hold_y) {
        const Index d = zeros + 3;
        const Vector B = numerator(zeros);
        const auto sums = two_pole_auxiliary_moments(signals.record(zeros, kind.Ts, hold, hold_y), E, kind.A, B, 0.5);
        ASSERT_EQ(sums.has_value(), hold == Hold::kZoh);
        if (!sums) return;
        const RegressionRecord general = signals.with_idle_input(zeros, kind.Ts, hold, hold_y);
        const RegressionMoments expected = auxiliary_moments(general, E, kind.A, {B, Vector::Zero(1)}, 0.5);
        const RegressionMoments of_phi = svf_moments(general, E, 0.5);
        const Vector z = expected.z_z.diagonal().head(d).cwiseSqrt(), phi = of_phi.z_phi.diagonal().head(d).cwiseSqrt();
        EXPECT_LT(difference(sums->z_phi, expected.z_phi.topLeftCorner(d, d), z, phi), kind.rounding);
        EXPECT_LT(difference(sums->z_y, expected.z_y.head(d), z, Vector::Constant(1, std::sqrt(of_phi.y_y))),
                  kind.rounding);
        EXPECT_LT(difference(sums->z_z, expected.z_z.topLeftCorner(d, d), z, z), kind.rounding);
    });
}

TEST_P(two_pole_moments, of_the_output_give_the_stored_simulation_s_error) {
    for_all([&](int zeros, Hold hold, Hold hold_y) {
        const Vector B = numerator(zeros);
        const auto sums = two_pole_output_moments(signals.record(zeros, kind.Ts, hold, hold_y), kind.A, B);
        ASSERT_TRUE(sums);
        const double squares = (*sums)(0, 0) - 2 * (*sums)(0, 1) + (*sums)(1, 1);
        const double expected = output_error_squares(signals.with_idle_input(zeros, kind.Ts, hold, hold_y),
                                                     {kind.A, kind.A}, {B, Vector::Zero(1)});
        EXPECT_NEAR(squares, expected, kind.rounding * ((*sums)(0, 0) + (*sums)(1, 1)));
        EXPECT_EQ((*sums)(0, 1), (*sums)(1, 0));
    });
}

INSTANTIATE_TEST_SUITE_P(
    of, two_pole_moments,
    testing::Values(Kind{"real_poles", Eigen::Vector3d(1, 4, 3), 0.01, 1500},
                    Kind{"complex_poles", Eigen::Vector3d(1, 0.6, 40), 0.01, 1503},
                    Kind{"equal_poles", Eigen::Vector3d(1, 6, 9), 0.01, 1496},
                    Kind{"nearly_equal_poles", Eigen::Vector3d(1, 6, 9 - 1e-12), 0.01, 1499},
                    // A derivative is a difference of two states there, which are larger by the ratio of the
                    // poles, 4000; a square of it has lost 1.6e7 epsilon, times what 1500 terms add.
                    Kind{"far_poles", Eigen::Vector3d(1, 40.01, 0.4), 0.01, 1501, 1e-8},
                    Kind{"an_integrator", Eigen::Vector3d(1, 2, 0), 0.01, 700},
                    Kind{"a_long_record", Eigen::Vector3d(1, 4, 13), 0.05, 100'007, 2.3e-11},
                    Kind{"a_short_record", Eigen::Vector3d(1, 4, 3), 0.02, 71}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(two_pole_moments_of_other_kinds, are_left_to_the_general_way) {
    const Signals signals(1000);
    const Eigen::Vector3d A(1, 4, 3);
    const Vector B = Vector::Ones(1);
    const auto made = [&](const RegressionRecord& record, const Vector& den, const Vector& num) {
        const bool refined = two_pole_refined_moments(record, den, num, false).has_value();
        EXPECT_EQ(two_pole_svf_moments(record, den, 1).has_value(), refined);
        EXPECT_EQ(two_pole_auxiliary_moments(record, den, den, num, 1).has_value(), refined);
        EXPECT_EQ(two_pole_output_moments(record, den, num).has_value(), refined);
        return refined;
    };
    const RegressionRecord record = signals.record(0, 0.01, Hold::kZoh, Hold::kFoh);
    EXPECT_TRUE(made(record, A, B));
    EXPECT_FALSE(made(record, Eigen::Vector2d(1, 3), B)) << "one pole";
    EXPECT_FALSE(made(record, Eigen::Vector4d(1, 6, 11, 6), B)) << "three poles";
    EXPECT_FALSE(made(signals.record(2, 0.01, Hold::kZoh, Hold::kFoh), A, Vector::Ones(3))) << "two zeros";
    EXPECT_FALSE(made(signals.record(0, 1, Hold::kZoh, Hold::kFoh), A, B)) << "sampled slowly";
    EXPECT_FALSE(made(signals.with_idle_input(0, 0.01, Hold::kZoh, Hold::kFoh), A, B)) << "two inputs";
    EXPECT_FALSE(made(record, A * std::nan(""), B)) << "not finite";
    RegressionRecord late = record;
    late.delays = {0.01};
    EXPECT_FALSE(made(late, A, B)) << "a delay";
    const Signals few(8 * Lanes::kWidth - 1);
    EXPECT_FALSE(made(few.record(0, 0.01, Hold::kZoh, Hold::kFoh), A, B)) << "few samples";
}

// No multiple of the last state alone is the output then.
TEST(two_pole_moments_of_other_kinds, an_output_without_gain_is_left_to_the_general_way) {
    const Signals signals(1000);
    EXPECT_FALSE(two_pole_output_moments(signals.record(0, 0.01, Hold::kZoh, Hold::kFoh), Eigen::Vector3d(1, 4, 3),
                                         Vector::Zero(1)));
}

// Hardly anything passes the filter: the squares of what does are not found from how they grow, where they cancel. (A
// derivative is a difference of states here that are larger by 1/(lambda Ts)^2 = 1e8 than it.)
TEST(two_pole_moments_of_other_kinds, a_signal_that_the_filter_stops_keeps_its_digits) {
    Signals signals(20'011);
    for (Index k = 0; k < signals.y.size(); ++k) signals.y[k] = k % 2 == 0 ? 1 : -1;
    for (const Hold hold_y : {Hold::kZoh, Hold::kFoh})
        expect_svf_moments(signals, 0, 0.01, Hold::kZoh, hold_y, Eigen::Vector3d(1, 0.02, 1e-4), 1e-5);
}

}  // namespace test_two_pole_moments
