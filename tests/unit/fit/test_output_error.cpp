#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/fit/output_error.h"
#include "numerics/signals/random.h"

namespace test_output_error {

using namespace dynlab;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// c exp(-r t), theta = [c, r].
class Decay : public OutputErrorModel {
  public:
    explicit Decay(const Vector& t) : t_(t) { set_free(2); }
    Decay& within(const Vector& lower, const Vector& upper) {
        lower_ = lower;
        upper_ = upper;
        return *this;
    }
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override {
        EXPECT_TRUE((theta.array() >= lower_.array()).all() && (theta.array() <= upper_.array()).all());
        const Vector decay = (-theta[1] * t_).array().exp();
        output = theta[0] * decay;
        if (!sensitivities) return;
        sensitivities->resize(t_.size(), 2);
        sensitivities->col(0) = decay;
        sensitivities->col(1) = -theta[0] * t_.cwiseProduct(decay);
    }

  private:
    Vector t_;
};

const Vector kTimes = Vector::LinSpaced(50, 0, 5);

TEST(output_error, finds_the_truth_of_exact_data) {  // oracle: analytic
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp();
    FitOptions options;
    options.tolerance = 1e-10;
    const auto solution = minimize_output_error(Decay(kTimes), y, Vector{{1.0, 0.1}}, options);
    EXPECT_EQ(solution.termination, Termination::kConverged);
    EXPECT_NEAR(solution.theta[0], 2.5, 1e-11);
    EXPECT_NEAR(solution.theta[1], 0.8, 1e-11);
    EXPECT_LT(solution.loss, 1e-24);
}

TEST(output_error, is_stationary_with_the_stated_covariance) {  // oracle: definition
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp() + 0.1 * RandomStream(1).normal(50).array();
    FitOptions options;
    options.tolerance = 1e-10;
    const Decay model = Decay(kTimes);
    const auto solution = minimize_output_error(model, y, Vector{{1.0, 0.1}}, options);
    Vector output;
    Matrix J;
    model.simulate(solution.theta, output, &J);
    EXPECT_LT((J.transpose() * (y - output)).cwiseAbs().maxCoeff(), 1e-8);
    const double variance = (y - output).squaredNorm() / 48;
    EXPECT_NEAR(solution.noise_variance[0], variance, 1e-14);
    const Matrix P = variance * (J.transpose() * J).inverse();
    EXPECT_LT((solution.covariance - P).cwiseAbs().maxCoeff(), 1e-12);
    for (std::size_t i = 1; i < solution.trace.size(); ++i)
        EXPECT_LE(solution.trace[i].loss, solution.trace[i - 1].loss * (1 + 1e-9));
}

TEST(output_error, stays_within_bounds_and_says_where_it_was_held) {  // oracle: analytic, linear problem at the bound
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp();
    const Decay model = Decay(kTimes).within(Vector{{-kInfinity, 0.0}}, Vector{{kInfinity, 0.5}});
    const auto solution = minimize_output_error(model, y, Vector{{1.0, 0.1}});
    EXPECT_EQ(solution.theta[1], 0.5);
    EXPECT_TRUE(solution.at_bound[1]);
    EXPECT_FALSE(solution.at_bound[0]);
    const Vector decay = (-0.5 * kTimes).array().exp();
    EXPECT_NEAR(solution.theta[0], decay.dot(y) / decay.squaredNorm(), 1e-6);
    EXPECT_EQ(solution.covariance(1, 1), 0);
    EXPECT_GT(solution.covariance(0, 0), 0);
}

TEST(output_error, starts_outside_the_bounds_are_moved_in) {  // oracle: definition, checked in the model
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp();
    const Decay model = Decay(kTimes).within(Vector{{0.0, 0.1}}, Vector{{10.0, 5.0}});
    const auto solution = minimize_output_error(model, y, Vector{{-3.0, 99.0}});
    EXPECT_NEAR(solution.theta[1], 0.8, 1e-6);
}

TEST(output_error, survives_a_hopeless_start) {  // oracle: always a finite answer no worse than the start
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp();
    const auto solution = minimize_output_error(Decay(kTimes), y, Vector{{1.0, -50.0}});
    EXPECT_TRUE(solution.theta.allFinite());
}

TEST(output_error, stops_on_request) {  // oracle: definition
    const Vector y = 2.5 * (-0.8 * kTimes).array().exp();
    FitOptions options;
    options.max_iterations = 2;
    auto solution = minimize_output_error(Decay(kTimes), y, Vector{{1.0, 0.1}}, options);
    EXPECT_EQ(solution.termination, Termination::kIterationLimit);
    EXPECT_EQ(solution.trace.size(), 2u);
    options.cancel = [] { return true; };
    solution = minimize_output_error(Decay(kTimes), y, Vector{{1.0, 0.1}}, options);
    EXPECT_EQ(solution.termination, Termination::kCanceled);
    EXPECT_EQ(solution.theta[0], 1.0);
}

TEST(output_error, refuses_misuse) {
    const Decay model = Decay(kTimes);
    EXPECT_THROW(minimize_output_error(model, Vector::Ones(50), Vector::Ones(3)), InvalidArgument);
    EXPECT_THROW(minimize_output_error(model, Vector::Ones(2), Vector::Ones(2)), InvalidArgument);
    FitOptions options;
    options.tolerance = 0;
    EXPECT_THROW(options.validate(), InvalidArgument);
    options = {};
    options.max_iterations = -1;
    EXPECT_THROW(options.validate(), InvalidArgument);
}

}  // namespace test_output_error
