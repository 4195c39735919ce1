#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/gradient_descent.h"
#include "numerics/estimators/linear_regression.h"
#include "numerics/signals/random.h"

namespace test_gradient_descent {

using namespace dynlab;

struct Problem {
    Matrix Phi;
    Vector y;
};

Problem line_problem() {
    RandomStream random(3);
    Problem p{Matrix::Ones(40, 2), Vector()};
    p.Phi.col(0) = Vector::LinSpaced(40, -1, 1);
    p.y = p.Phi * Vector{{-2.0, 5.0}} + 0.1 * random.normal(40);
    return p;
}

TEST(gradient_descent, ends_at_the_least_squares_solution) {  // oracle: second route
    const Problem p = line_problem();
    const auto result = gradient_descent(p.Phi, p.y);
    EXPECT_EQ(result.termination, Termination::kConverged);
    EXPECT_LT((result.theta - lsq(p.Phi, p.y).theta).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(result.loss.size(), result.iterations + 1);
    EXPECT_NEAR(result.loss[0], p.y.squaredNorm() / 40, 1e-14);
    EXPECT_NEAR(std::sqrt(result.loss[result.iterations]), lsq(p.Phi, p.y).rmse, 1e-12);
}

TEST(gradient_descent, one_parameter_converges_by_the_known_factor) {  // oracle: analytic, 1 - step lambda
    const Matrix Phi = Matrix::Constant(4, 1, 2.0);
    GradientDescentOptions options;
    options.step_size = 0.1;  // lambda = 4, so the error shrinks by 0.6 and the loss by 0.36
    const auto result = gradient_descent(Phi, Vector::Constant(4, 6.0), options);
    EXPECT_NEAR(result.theta[0], 3, 1e-9);
    for (Index i = 0; i < 10; ++i) EXPECT_NEAR(result.loss[i + 1] / result.loss[i], 0.36, 1e-9);
    EXPECT_NEAR(result.largest_step, 0.5, 1e-14);
}

TEST(gradient_descent, loss_never_grows_below_the_limit_and_runs_away_beyond_it) {  // oracle: theory of the method
    const Problem p = line_problem();
    GradientDescentOptions options;
    options.step_size = 0.99 * gradient_descent(p.Phi, p.y).largest_step;
    const auto stable = gradient_descent(p.Phi, p.y, options);
    for (Index i = 1; i < stable.loss.size(); ++i) EXPECT_LE(stable.loss[i], stable.loss[i - 1] * (1 + 1e-12));
    options.step_size = 1.05 * stable.largest_step;
    const auto wild = gradient_descent(p.Phi, p.y, options);
    EXPECT_EQ(wild.termination, Termination::kDiverged);
    EXPECT_NE(message_text(wild.message).find("too large"), std::string::npos);
    EXPECT_TRUE(wild.theta.allFinite());
}

TEST(gradient_descent, reports_when_it_was_too_slow) {  // justified: years uncentered have condition number 1e9
    Matrix Phi = Matrix::Ones(29, 2);
    Phi.col(0) = Vector::LinSpaced(29, 1896, 2020);
    const Vector y = 11 - 0.012 * (Phi.col(0).array() - 1896);
    GradientDescentOptions options;
    options.max_iterations = 500;
    options.tolerance = 1e-12;
    const auto result = gradient_descent(Phi, y, options);
    EXPECT_EQ(result.termination, Termination::kIterationLimit);
    EXPECT_EQ(result.iterations, 500);
    EXPECT_GT(result.condition_number, 1e8);
    EXPECT_NE(message_text(result.message).find("Center and scale"), std::string::npos);
}

TEST(gradient_descent, can_be_canceled) {  // oracle: definition
    const Problem p = line_problem();
    GradientDescentOptions options;
    int asked = 0;
    options.cancel = [&] { return ++asked > 5; };
    const auto result = gradient_descent(p.Phi, p.y, options);
    EXPECT_EQ(result.termination, Termination::kCanceled);
    EXPECT_EQ(result.iterations, 5);
}

TEST(gradient_descent, refuses_what_does_not_fit) {
    const Problem p = line_problem();
    EXPECT_THROW(gradient_descent(p.Phi, Vector::Ones(3)), InvalidArgument);
    EXPECT_THROW(gradient_descent(Matrix::Zero(5, 2), Vector::Ones(5)), InvalidArgument);
    EXPECT_THROW(gradient_descent(Matrix::Constant(5, 1, std::nan("")), Vector::Ones(5)), InvalidArgument);
    GradientDescentOptions options;
    options.step_size = -1;
    EXPECT_THROW(gradient_descent(p.Phi, p.y, options), InvalidArgument);
    options = {};
    options.start = Vector::Ones(3);
    EXPECT_THROW(gradient_descent(p.Phi, p.y, options), InvalidArgument);
}

}  // namespace test_gradient_descent
