// Oracles: the matrix exponential's series in 80 bits, and the recursion of the definition of a chain against the
// response of the continuous-time filter (transfer_response of another module).
#include "numerics/filters/delta_sampling.h"

#include <gtest/gtest.h>

#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/linalg/polynomial.h"

namespace test_delta_sampling {

using namespace dynlab;

using Long = long double;
using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

Vector sample_denominator(int n) {
    return power(Eigen::Vector2d(1, 1.3), n);
}

TEST(delta_sampling, step_is_the_series_of_the_exponential) {
    const double Ts = 0.1;
    for (int n = 1; n <= 4; ++n) {
        const SampledFilter<4> filter(sample_denominator(n), Ts, false);
        ASSERT_EQ(filter.states, n);
        LongMatrix A(n, n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) A(i, j) = filter.A(i, j);
        LongMatrix term = LongMatrix::Identity(n, n), E = LongMatrix::Zero(n, n), W = E;  // W = integral of exp(A t)
        for (int k = 1; k < 40; ++k) {
            W += static_cast<Long>(Ts) / k * term;
            term = (static_cast<Long>(Ts) / k * A * term).eval();
            E += term;
        }
        for (int i = 0; i < n; ++i) {
            EXPECT_NEAR(filter.G[i], static_cast<double>(W(i, 0)), 1e-15) << n;
            EXPECT_NEAR(filter.H0[i] + filter.H1[i], filter.G[i], 1e-16) << n;  // a constant, linearly interpolated
            for (int j = 0; j < n; ++j) EXPECT_NEAR(filter.E(i, j), static_cast<double>(E(i, j)), 1e-14) << n;
        }
    }
}

/// The first output of the signal: the chain's recursion, sample by sample.
Vector output_of(const DeltaSignal& signal, Index N) {
    const DeltaChain& chain = signal.chain;
    const std::size_t n = static_cast<std::size_t>(chain.order);
    std::vector<Long> X(n + 1, 0);
    Vector y = Vector::Zero(N);
    for (Index k = chain.begin; k < N; ++k) {
        if (k == chain.begin)
            for (std::size_t j = 0; j < n; ++j) X[j] += chain.start[j];
        const Index at = k - chain.begin;
        X[n] = at < chain.count ? chain.samples[at] : 0;
        for (std::size_t j = 0; j < n; ++j) X[n] -= chain.alpha[j] * X[j];
        Long sum = 0;
        for (std::size_t j = 0; j <= n; ++j) sum += signal.outputs[0][j] * X[j];
        y[k] = static_cast<double>(sum);
        for (std::size_t j = 0; j < n; ++j) X[j] += X[j + 1];
    }
    return y;
}

TEST(delta_sampling, chain_gives_the_response_of_the_filter) {
    const double Ts = 0.1;
    const Index N = 60;
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = std::sin(0.3 * static_cast<double>(k)) + (k > 20 ? 1 : 0);
    for (int n = 1; n <= 4; ++n) {
        const Vector den = sample_denominator(n);
        const SampledFilter<4> filter(den, Ts, false);
        StateOutputs<4> outputs;
        outputs.count = 1;
        outputs.C[0][n - 1] = 1;  // the last state of the companion form is 1/den u
        for (const Hold hold : {Hold::kZoh, Hold::kFoh})
            for (const double delay : {0.0, 0.3, 0.14}) {
                const bool between = delay == 0.14, longer = between && hold == Hold::kFoh;
                const DeltaSignal signal = delta_signal(filter, outputs, SampleView(u.data(), N), hold, delay, longer);
                const Vector expected = transfer_response(Vector::Ones(1), den, delay, u, Ts, hold);
                EXPECT_LT((output_of(signal, N) - expected).cwiseAbs().maxCoeff(),
                          1e-12 * expected.cwiseAbs().maxCoeff())
                    << n << " poles, delay " << delay << " s";
            }
    }
}

}  // namespace test_delta_sampling
