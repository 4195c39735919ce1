#include <gtest/gtest.h>

#include <cmath>

#include "numerics/filters/exact_filter.h"
#include "numerics/filters/irregular_filter.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"

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
            ExactFilter(discretise(kA, kB, kC, kD, Ts, hold, delay)).run(u, x, regular);
            const Vector t = Vector::LinSpaced(60, 0, 59 * Ts);
            const Matrix irregular = IrregularFilter(kA, kB, kC, kD, hold, delay).run(u, t, x);
            EXPECT_LT((irregular - regular).lpNorm<Eigen::Infinity>(), 1e-12) << "delay " << delay;
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

}  // namespace test_irregular_filter
