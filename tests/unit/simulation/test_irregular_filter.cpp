#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/exact_filter.h"
#include "numerics/simulation/irregular_filter.h"

namespace test_irregular_filter {

using namespace dynlab;

const Matrix kA = companion(Vector{{1, 0.6, 4}}), kC{{1, 2}, {0, 3}};
const Vector kB{{1, 0}}, kD{{0.5, 0}};

Vector irregular_instants(Index N) {
    RandomStream random(3);
    Vector t(N);
    double time = 2;
    for (double& instant : t) {
        instant = time;
        time += 0.01 + 0.2 * random.uniform();
    }
    return t;
}

TEST(irregular_filter, equals_the_regular_filter_on_regular_instants) {  // oracle: second route
    const Vector u = RandomStream(4).normal(60), x{{0.3, -1}};
    for (const Hold hold : {Hold::kZoh, Hold::kFoh})
        for (const double delay : {0.0, 0.25, 0.5, 1.37}) {
            const double Ts = 0.25;
            Matrix regular(60, 2);
            ExactFilter(discretize(kA, kB, kC, kD, Ts, hold, delay)).run(u, x, regular);
            const Vector t = Vector::LinSpaced(60, 0, 59 * Ts);
            const Matrix irregular = IrregularFilter(kA, kB, kC, kD, hold, delay).run(u, t, x);
            EXPECT_LT((irregular - regular).lpNorm<Eigen::Infinity>(), 1e-12) << "delay " << delay;
        }
}

/// Two systems of the same poles one behind the other, as the sensitivities of an output have them.
Matrix cascade(const Matrix& A) {
    const Index n = A.rows();
    Matrix both = Matrix::Zero(2 * n, 2 * n);
    both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = A;
    both(n, n - 1) = 1;
    return both;
}

std::vector<Matrix> systems_of_all_sizes() {
    std::vector<Matrix> all;
    for (const Vector& den :
         {Vector{{1, 3}}, Vector{{1, 100, 4e4}}, Vector{{1, 4, 5, 2}}, Vector{{1, 20.2, 104.01, 20.8, 1.02}},
          Vector{{1, 8, 24, 32, 16}}, Vector{{1, 5, 10, 10, 5, 1}}, Vector{{1, 0, 0, 0}},
          // Real poles far apart, one at zero and very fast ones among them.
          Vector{{1, 4, 3}}, Vector{{1, 1e5 + 3, 3e5}}, Vector{{1, 3, 0}}, Vector{{1, 11, 31, 21}},
          Vector{{1, 2011, 22010, 2e4}}, Vector{{1, 85, 1490, 7400, 5985}}}) {
        all.push_back(companion(den));
        all.push_back(cascade(all.back()));
    }
    all.push_back(companion(Vector{{1, 11, 55, 165, 330, 462, 462, 330, 165, 55, 11, 1}}));
    return all;
}

// Oracle: a matrix exponential for every step. Steps from a thousandth to a hundred times the fastest time constant,
// from one to eleven states, several times the same poles among them, and integrators; from rest and from elsewhere.
TEST(irregular_filter, equals_the_matrix_exponential_of_every_step) {
    for (const Matrix& A : systems_of_all_sizes()) {
        const Index n = A.rows(), N = 300;
        const Vector B = Vector::Unit(n, 0), u = RandomStream(7).normal(N);
        RandomStream random(8);
        Vector t(N);
        for (Index k = 0; k < N; ++k) t[k] = k == 0 ? 1 : t[k - 1] + 1e-4 * std::pow(10, 4 * random.uniform());
        for (const auto& [hold, level] :
             {std::pair(Hold::kZoh, 0.1), {Hold::kFoh, 0.1}, {Hold::kZoh, 0.0}, {Hold::kFoh, 0.0}}) {
            Vector x = level * Vector::Ones(n);
            Matrix expected(N, n);
            for (Index k = 0; k < N; ++k) {
                expected.row(k) = x;
                if (k + 1 == N) break;
                const StepMatrices step = exact_step(A, B, t[k + 1] - t[k]);
                x = step.F * x + step.H0.col(0) * u[k] + step.H1.col(0) * u[hold == Hold::kFoh ? k + 1 : k];
            }
            IrregularFilter filter(A, B, Matrix::Identity(n, n), Vector::Zero(n), hold);
            const Matrix found = filter.run(u, t, level * Vector::Ones(n));
            for (Index i = 0; i < n; ++i)
                EXPECT_LT((found.col(i) - expected.col(i)).norm(), 1e-11 * expected.col(i).norm())
                    << n << ", " << i << ", from " << level;
        }
    }
}

// Oracle: second route, an input of levels that differ by less than what is asked of the result: each sample is a step.
TEST(irregular_filter, an_input_that_stays_for_several_samples_is_held) {
    const Index N = 200;
    const Vector t = irregular_instants(N);
    RandomStream random(6);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = k > 0 && random.uniform() < 0.8 ? u[k - 1] : random.uniform() - 0.5;
    const Vector moving = u + 1e-15 * Vector::LinSpaced(N, 0, static_cast<double>(N));
    for (const double delay : {0.0, 0.33, 2.5}) {
        IrregularFilter filter(kA, kB, kC, kD, Hold::kZoh, delay);
        EXPECT_LT((filter.run(u, t, Vector::Zero(2)) - filter.run(moving, t, Vector::Zero(2))).norm(), 1e-10) << delay;
    }
}

TEST(irregular_filter, extra_instants_change_nothing) {  // oracle: property, sampling a straight input more often
    const Index N = 40;
    const Vector t = irregular_instants(N), u = RandomStream(5).normal(N);
    Vector more_t(2 * N - 1), more_u(2 * N - 1);
    for (Index k = 0; k + 1 < N; ++k) {
        const double part = 0.3;
        more_t(2 * k) = t(k);
        more_u(2 * k) = u(k);
        more_t(2 * k + 1) = t(k) + part * (t(k + 1) - t(k));
        more_u(2 * k + 1) = u(k) + part * (u(k + 1) - u(k));
    }
    more_t(2 * N - 2) = t(N - 1);
    more_u(2 * N - 2) = u(N - 1);
    for (const double delay : {0.0, 0.33}) {
        IrregularFilter filter(kA, kB, kC, kD, Hold::kFoh, delay);
        const Matrix few = filter.run(u, t, Vector::Zero(2)), many = filter.run(more_u, more_t, Vector::Zero(2));
        for (Index k = 0; k < N; ++k) EXPECT_LT((many.row(2 * k) - few.row(k)).norm(), 1e-13) << k;
    }
}

// Oracle: the definition: the last sample that has arrived, or, with linear interpolation, u(t - delay) itself.
TEST(irregular_filter, a_gain_alone_delays_and_scales) {
    const Index N = 50;
    const Vector t = irregular_instants(N), u = RandomStream(9).normal(N);
    for (const double delay : {0.0, 0.47}) {
        const auto run = [&](Hold hold) {
            return Vector(IrregularFilter(Matrix(0, 0), Vector(0), Matrix(1, 0), Vector::Constant(1, 2), hold, delay)
                              .run(u, t, Vector(0)));
        };
        const Vector held = run(Hold::kZoh), straight = run(Hold::kFoh);
        for (Index k = 0; k < N; ++k) {
            Index last = -1;
            while (last + 1 < N && t[last + 1] + delay <= t[k]) ++last;
            const double part = last < 0 || last + 1 == N ? 0 : (t[k] - delay - t[last]) / (t[last + 1] - t[last]);
            EXPECT_EQ(held[k], last < 0 ? 0 : 2 * u[last]) << k;
            const double expected = last < 0 ? 0 : 2 * (u[last] + (part > 0 ? part * (u[last + 1] - u[last]) : 0));
            EXPECT_NEAR(straight[k], expected, 1e-13) << k;
        }
    }
}

// Oracle: analytic. The input never changes; steps are a millionth to a million times the time constant.
TEST(irregular_filter, a_constant_input_is_followed_for_ever) {
    const double pole = 1e3;
    Vector t(200);
    t[0] = 0;
    for (Index k = 1; k < t.size(); ++k) t[k] = t[k - 1] + std::pow(10, -9 + 12 * static_cast<double>(k) / 200);
    IrregularFilter filter(Matrix::Constant(1, 1, -pole), Vector::Ones(1), Matrix::Ones(1, 1), Vector::Zero(1),
                           Hold::kZoh);
    const Matrix y = filter.run(Vector::Ones(200), t, Vector::Constant(1, 3));
    for (Index k = 0; k < t.size(); ++k)
        EXPECT_NEAR(y(k, 0), 3 * std::exp(-pole * t[k]) - std::expm1(-pole * t[k]) / pole, 1e-13) << t[k];
}

/// Steps are kept for the next run. Oracle: a thread that has run nothing before.
TEST(irregular_filter, what_was_run_before_changes_nothing) {
    Vector u = RandomStream(4).normal(300), t = irregular_instants(300);
    const Vector rest = Vector::Zero(2);
    const auto expect_as_first_run = [&](Hold hold, double delay, const char* what) {
        const auto run = [&] { return IrregularFilter(kA, kB, kC, kD, hold, delay).run(u, t, rest); };
        Matrix first;
        std::thread([&] { first = run(); }).join();
        EXPECT_EQ(run(), first) << what;
    };
    for (int round = 0; round < 3; ++round) {
        for (const Hold hold : {Hold::kZoh, Hold::kFoh})
            for (const double delay : {0.0, 0.25, 0.26, 1.37, 0.25})
                expect_as_first_run(hold, delay, "another delay or hold");
        u[17] += 1;  // in its place
        expect_as_first_run(Hold::kZoh, 0.25, "another input");
        t[200] += 1e-3;
        expect_as_first_run(Hold::kZoh, 0.25, "another instant");
    }
    const Vector longer = u;
    u = longer.head(299);
    t = Vector(t.head(299));
    expect_as_first_run(Hold::kZoh, 0.25, "fewer samples");
}

}  // namespace test_irregular_filter
