#include <gtest/gtest.h>

#include <cmath>

#include "numerics/error.h"
#include "numerics/estimators/arx.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "numerics/models/convert.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"
#include "support/difference_equation.h"

namespace test_discrete_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kRuns = 200;

struct Study {
    Vector mean, spread, reported;
};

/// Runs a method on `clean` plus noise of standard deviation sigma, or on what `make` gives for a seed.
template <class Make, class Method>
Study monte_carlo(Index d, Make make, Method method) {
    Matrix estimates(kRuns, d);
    Study study{Vector::Zero(d), Vector::Zero(d), Vector::Zero(d)};
    for (int run = 0; run < kRuns; ++run) {
        const Fit result = method(make(static_cast<std::uint32_t>(run + 1)));
        estimates.row(run) = result.theta.transpose();
        study.reported += result.std / kRuns;
    }
    study.mean = estimates.colwise().mean().transpose();
    study.spread =
        ((estimates.rowwise() - study.mean.transpose()).colwise().squaredNorm() / (kRuns - 1)).cwiseSqrt().transpose();
    return study;
}

// The relative error of a standard deviation from 200 runs is 1/sqrt(400) = 5 %: 18 % is 3.6 of them.
void expect_honest(const Study& study, const Vector& truth) {
    for (Index i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(study.reported[i] / study.spread[i], 1, 0.18) << i;
        EXPECT_NEAR(study.mean[i], truth[i], 5 * study.spread[i] / std::sqrt(kRuns)) << i;
    }
}

const PolynomialOrders kOutputError = PolynomialOrders::output_error({2}, {2}, {1});
const Vector kTruth{{-1.5, 0.7, 1, 0.5}};

IdData with_white_output_noise(std::uint32_t seed) {
    const Vector u = random_levels(1000, 4, 77);
    const Vector x = model_output(PolynomialModel(kOutputError, kTruth, 1), u, Vector::Zero(1000));
    return IdData(Matrix(x + RandomStream(seed).normal(1000)), Matrix(u), 1);
}

/// The course's system 2/(s^2 + 4 s + 3) with sigma 0.2: its denominator is what a method shall find.
const TransferFunction& course_system() {
    static const TransferFunction G(Vector{{2}}, Vector{{1, 4, 3}});
    return G;
}
IdData course_system_data(double Ts, Index N, std::uint32_t seed) {
    const Vector u = random_levels(N, static_cast<Index>(std::lround(1 / Ts)), 5);
    const Vector x = lsim(course_system(), u, Ts);
    return IdData(Matrix(x + 0.2 * RandomStream(seed).normal(N)), Matrix(u), Ts);
}

TEST(discrete_statistics, standard_errors_of_oe_are_honest) {  // oracle: statistics, fixed seeds
    expect_honest(monte_carlo(4, with_white_output_noise,
                              [](const IdData& data) { return oe(data, kOutputError, FitOptions{}.from_rest()); }),
                  kTruth);
}

TEST(discrete_statistics, standard_errors_of_sriv_are_honest) {  // oracle: statistics, fixed seeds
    expect_honest(monte_carlo(4, with_white_output_noise,
                              [](const IdData& data) { return sriv(data, kOutputError, FitOptions{}.from_rest()); }),
                  kTruth);
}

TEST(discrete_statistics, standard_errors_of_arx_are_honest_for_equation_noise) {  // oracle: statistics, fixed seeds
    const PolynomialOrders orders = PolynomialOrders::arx(2, {2}, {1});
    const auto make = [&](std::uint32_t seed) {
        const Vector u = random_levels(1000, 4, 77);
        const Vector e = RandomStream(seed).normal(1000);
        return IdData(Matrix(model_output(PolynomialModel(orders, kTruth, 1), u, e)), Matrix(u), 1);
    };
    expect_honest(monte_carlo(4, make, [&](const IdData& data) { return arx(data, orders); }), kTruth);
}

// Why direct continuous-time methods exist: at Ts = 0.01 with sigma 0.2 the equation error of arx is all noise, and its
// continuous-time equal has poles that have nothing to do with -1 and -3 (or none at all).
TEST(discrete_statistics, arx_of_fast_samples_says_nothing_of_the_poles) {  // oracle: the known system
    const Vector u = prbs(4, 100), x = lsim(course_system(), u, 0.01);
    int useless = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const IdData data(Matrix(x + 0.2 * RandomStream(seed).normal(x.size())), Matrix(u), 0.01);
        const auto result = arx(data, PolynomialOrders::arx(2, {1}, {1}));
        EXPECT_LT(result.theta[0], -0.2);
        bool wrong = true;
        try {
            const TransferFunction G = d2c(result.polynomial->transfer_function());
            wrong = std::abs(G.den()[1] / 4 - 1) > 5 || std::abs(G.den()[2] / 3 - 1) > 5;
        } catch (const InvalidArgument&) {  // a pole on the negative real axis has no continuous-time equal
        }
        useless += wrong ? 1 : 0;
    }
    EXPECT_EQ(useless, 20);
}

TEST(discrete_statistics, slower_samples_suit_oe_and_sriv) {  // oracle: the known system, its own standard errors
    const TransferFunction truth = c2d(course_system(), 0.2);
    const Vector expected{{truth.den()[1], truth.den()[2], truth.num()[0], truth.num()[1]}};
    const auto make = [](std::uint32_t seed) { return course_system_data(0.2, 1500, seed); };
    for (const auto& method : {oe, sriv}) {
        const Study study = monte_carlo(4, make, [&](const IdData& data) { return method(data, kOutputError, {}); });
        for (Index i = 0; i < 4; ++i) EXPECT_NEAR(study.mean[i], expected[i], 0.5 * study.spread[i]) << i;
        const TransferFunction G = d2c(PolynomialModel(kOutputError, study.mean, 0.2).transfer_function());
        EXPECT_NEAR(G.den()[1], 4, 0.4);
        EXPECT_NEAR(G.den()[2], 3, 0.3);
    }
}

// Good: the simulation error is at most 1 % above that of the true system, as with continuous-time methods.
TEST(discrete_statistics, default_settings_find_good_models_of_fast_samples) {  // oracle: the known systems
    struct Problem {
        TransferFunction G;
        Vector u;
        double sigma;
        int poles, runs;
    };
    const TransferFunction rao_garnier(Vector{{-6400, 1600}}, Vector{{1, 5, 408, 416, 1600}});
    const Problem problems[] = {{course_system(), prbs(4, 100), 0.4, 2, 100},
                                {rao_garnier, prbs(10, 7), 3.358, 4, 10}};  // signal-to-noise ratio 0 dB
    for (const Problem& problem : problems) {
        const Vector x = lsim(problem.G, problem.u, 0.01);
        const PolynomialOrders orders = PolynomialOrders::output_error({problem.poles}, {problem.poles}, {1});
        for (int run = 1; run <= problem.runs; ++run) {
            const Vector e = problem.sigma * RandomStream(static_cast<std::uint32_t>(run)).normal(x.size());
            const IdData data(Matrix(x + e), Matrix(problem.u), 0.01);
            const double limit = 1.01 * e.squaredNorm() / static_cast<double>(e.size());
            EXPECT_LT(oe(data, orders, FitOptions{}.from_rest()).loss, limit) << run;
            EXPECT_LT(sriv(data, orders, FitOptions{}.from_rest()).loss, limit) << run;
        }
    }
}

}  // namespace test_discrete_statistics
