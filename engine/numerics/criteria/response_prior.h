#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// What is assumed of an impulse response g_0 .. g_n before the data are seen: g ~ N(0, c K), K by one of these.
enum class ResponseKernel {
    kTc,  ///< "TC", tuned/correlated: a^max(i, j)
    kDc,  ///< "DC", diagonal/correlated: a^((i + j)/2) r^|i - j|
    kSs,  ///< "SS", stable spline: a^(i + j + max(i, j))/2 - a^(3 max(i, j))/6
};

struct ResponsePrior {
    ResponseKernel kernel = ResponseKernel::kTc;
    double decay = 0.9;        ///< a, between 0 and 1
    double correlation = 0.9;  ///< r, of "DC" alone
    double ratio = 1;          ///< c over the noise variance
};

/// K for `size` values of the response.
Matrix prior_kernel(const ResponsePrior& prior, Index size);

/// The sums of products over N rows from which the marginal likelihood and the posterior of y = Phi g + e follow.
struct ResponseSums {
    Matrix gram;        ///< Phi'Phi
    Vector projection;  ///< Phi'y
    double energy = 0;  ///< y'y
    double count = 0;   ///< N, rows that are free
};

/// -2 log of the marginal likelihood of y for the prior's a and r, without its constants: smallest over c and the noise
/// variance, whose ratio is put into `prior`.
double prior_loss(const ResponseSums& sums, ResponsePrior& prior);

/// Returns the prior of the given kernel for which y is most likely. The search tries values of a for which the prior
/// falls to a thousandth within 10 % to 1000 % of the response's length, then refines a and r in turns. One evaluation
/// costs n^3 operations, independent of the length of the data.
ResponsePrior most_likely_prior(const ResponseSums& sums, ResponseKernel kernel);

/// Mean and covariance of g given y, with the noise variance and c that are most likely for the prior's ratio.
struct ResponsePosterior {
    Vector mean, null_std;  ///< null_std: standard errors of the mean if g were zero
    Matrix covariance;
    double noise_variance = 0, scale = 0;  ///< sigma^2 and c
};
ResponsePosterior response_posterior(const ResponseSums& sums, const ResponsePrior& prior);

}  // namespace dynlab::inline numerics
