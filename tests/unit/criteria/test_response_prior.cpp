#include "numerics/criteria/response_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "numerics/signals/random.h"

namespace test_response_prior {

using namespace dynlab;

constexpr ResponseKernel kAll[] = {ResponseKernel::kTc, ResponseKernel::kDc, ResponseKernel::kSs};

/// All equations of a data set of 100 samples.
struct Dense {
    Matrix Phi;
    Vector y;
};
Dense equations(Index n, std::uint32_t seed) {
    RandomStream chance(seed);
    const Vector u = chance.normal(100 + n);
    Dense dense{Matrix(100, n), Vector(100)};
    for (Index i = 0; i < n; ++i) dense.Phi.col(i) = u.segment(n - i, 100);
    Vector g(n);
    for (Index i = 0; i < n; ++i)
        g[i] = std::exp(-0.2 * static_cast<double>(i)) * std::sin(0.5 * static_cast<double>(i + 1));
    dense.y = dense.Phi * g + 0.3 * chance.normal(100);
    return dense;
}
ResponseSums sums_of(const Dense& dense) {
    return {dense.Phi.transpose() * dense.Phi, dense.Phi.transpose() * dense.y, dense.y.squaredNorm(), 100};
}

/// Written out from the definitions of Chen, Ohlsson and Ljung (2012), but for the index from 0 on.
Matrix kernel_by_definition(const ResponsePrior& prior, Index n) {
    Matrix K(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int m = std::max(i, j);
            if (prior.kernel == ResponseKernel::kTc)
                K(i, j) = std::min(std::pow(prior.decay, i), std::pow(prior.decay, j));
            if (prior.kernel == ResponseKernel::kDc)
                K(i, j) = std::pow(prior.decay, 0.5 * (i + j)) * std::pow(prior.correlation, std::abs(i - j));
            if (prior.kernel == ResponseKernel::kSs)
                K(i, j) = 0.5 * std::pow(prior.decay, i + j + m) - std::pow(prior.decay, 3 * m) / 6;
        }
    return K;
}

/// -2 log likelihood of y ~ N(0, c Phi K Phi' + s I) but for its constant, with N x N algebra.
double dense_loss(const Dense& dense, const ResponsePrior& prior, double c, double s) {
    const Matrix K = kernel_by_definition(prior, dense.Phi.cols());
    const Matrix S = c * dense.Phi * K * dense.Phi.transpose() + s * Matrix::Identity(100, 100);
    const Eigen::LLT<Matrix> root(S);
    return dense.y.dot(root.solve(dense.y)) + 2 * Matrix(root.matrixL()).diagonal().array().log().sum();
}

TEST(response_prior, posterior_is_the_dense_one) {  // oracle: conditioning of y and g, N x N
    for (const ResponseKernel kernel : kAll) {
        const Dense dense = equations(30, 1);
        const ResponsePrior prior = most_likely_prior(sums_of(dense), kernel);
        const ResponsePosterior posterior = response_posterior(sums_of(dense), prior);
        const Matrix K = posterior.scale * kernel_by_definition(prior, 30);
        const Matrix S = dense.Phi * K * dense.Phi.transpose() + posterior.noise_variance * Matrix::Identity(100, 100);
        const Matrix gain = K * dense.Phi.transpose() * S.inverse();
        const Vector mean = gain * dense.y;
        const Matrix unseen = Matrix::Identity(30, 30) - gain * dense.Phi;  // without differences of large numbers
        const Matrix covariance = unseen * K * unseen.transpose() + posterior.noise_variance * gain * gain.transpose();
        EXPECT_LT((posterior.mean - mean).cwiseAbs().maxCoeff(), 1e-8 * mean.cwiseAbs().maxCoeff());
        EXPECT_LT((posterior.covariance - covariance).cwiseAbs().maxCoeff(), 1e-8 * covariance.cwiseAbs().maxCoeff());
        const Matrix noise = posterior.noise_variance * gain * gain.transpose();
        EXPECT_LT((posterior.null_std - noise.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(), 1e-8);
    }
}

TEST(response_prior, is_the_most_likely_one) {  // oracle: the dense likelihood, which no neighbor exceeds
    for (const ResponseKernel kernel : kAll) {
        const Dense dense = equations(30, 2);
        const ResponsePrior prior = most_likely_prior(sums_of(dense), kernel);
        const ResponsePosterior posterior = response_posterior(sums_of(dense), prior);
        const double best = dense_loss(dense, prior, posterior.scale, posterior.noise_variance);
        for (const double factor : {0.7, 0.9, 1.1, 1.5}) {
            EXPECT_GT(dense_loss(dense, prior, factor * posterior.scale, posterior.noise_variance), best);
            EXPECT_GT(dense_loss(dense, prior, posterior.scale, factor * posterior.noise_variance), best);
            ResponsePrior other = prior;
            other.decay = std::pow(prior.decay, factor);
            other.correlation = kernel == ResponseKernel::kDc ? prior.correlation : 0;
            EXPECT_GT(dense_loss(dense, other, posterior.scale, posterior.noise_variance), best - 1e-3);
        }
    }
}

TEST(response_prior, losses_differ_as_the_dense_ones) {  // oracle: differences of dense likelihoods at their best c, s
    const Dense dense = equations(20, 3);
    const ResponseSums sums = sums_of(dense);
    for (const ResponseKernel kernel : kAll) {
        double first = 0, first_dense = 0;
        for (const double decay : {0.95, 0.8, 0.6}) {
            ResponsePrior prior{kernel, decay, 0.7};
            const double loss = prior_loss(sums, prior);
            const ResponsePosterior at = response_posterior(sums, prior);
            const double own = dense_loss(dense, prior, at.scale, at.noise_variance);
            if (decay == 0.95) first = loss, first_dense = own;
            EXPECT_NEAR(loss - first, own - first_dense, 1e-6);
        }
    }
}

TEST(response_prior, kernels_are_those_of_the_paper) {  // oracle: the definitions
    for (const ResponseKernel kernel : kAll) {
        const ResponsePrior prior{kernel, 0.8, 0.6};
        EXPECT_LT((prior_kernel(prior, 12) - kernel_by_definition(prior, 12)).cwiseAbs().maxCoeff(), 1e-15);
    }
}

TEST(response_prior, dc_takes_the_correlation_that_the_response_has) {  // oracle: TC is DC with r = sqrt(a)
    const Dense dense = equations(30, 4);
    ResponsePrior tc{ResponseKernel::kTc, 0.8}, dc{ResponseKernel::kDc, 0.8, std::sqrt(0.8)};
    EXPECT_NEAR(prior_loss(sums_of(dense), tc), prior_loss(sums_of(dense), dc), 1e-9);
    ResponsePrior best = most_likely_prior(sums_of(dense), ResponseKernel::kDc);
    ResponsePrior best_tc = most_likely_prior(sums_of(dense), ResponseKernel::kTc);
    EXPECT_LE(prior_loss(sums_of(dense), best), prior_loss(sums_of(dense), best_tc) + 1e-6);
}

TEST(response_prior, one_value_is_a_response_too) {  // oracle: a scalar posterior by hand
    const ResponseSums sums{Matrix::Constant(1, 1, 50), Vector::Constant(1, 25), 14, 50};
    const ResponsePrior prior{ResponseKernel::kTc, 0.9, 0.9, 2};
    const ResponsePosterior posterior = response_posterior(sums, prior);
    EXPECT_NEAR(posterior.mean[0], 2 * 25 / (1 + 2 * 50.0), 1e-12);
    EXPECT_NEAR(posterior.covariance(0, 0), posterior.noise_variance * 2 / 101, 1e-12);
}

}  // namespace test_response_prior
