#pragma once
#include <cmath>

#include "numerics/fit/fit.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::test {

/// How an estimator's values lie about the truth, and what its standard errors say of it.
struct EstimatorStudy {
    Vector bias;          ///< in standard errors of the mean
    double distance = 0;  ///< of the mean from the truth in the metric of its covariance: all parameters together
    Vector reported;      ///< root mean square of the standard errors, relative to the scatter
};

/// `estimate(k)` returns the Fit of data set k, counted from 1.
template <class Estimate>
EstimatorStudy study_of(int data_sets, const Vector& truth, const Estimate& estimate) {
    Matrix theta(data_sets, truth.size()), std(data_sets, truth.size());
    for (int k = 0; k < data_sets; ++k) {
        const Fit fit = estimate(static_cast<std::uint32_t>(k + 1));
        theta.row(k) = fit.theta.transpose();
        std.row(k) = fit.std.transpose();
    }
    const Vector mean = theta.colwise().mean(), off = mean - truth;
    const Matrix around = theta.rowwise() - mean.transpose();
    const Matrix covariance = around.transpose() * around / (data_sets - 1);
    const Vector scatter = covariance.diagonal().cwiseSqrt();
    const double root = std::sqrt(static_cast<double>(data_sets));
    return {root * off.cwiseQuotient(scatter), root * std::sqrt(off.dot(solve_by_lu(covariance, off).x.col(0))),
            (std.colwise().squaredNorm().transpose() / data_sets).cwiseSqrt().cwiseQuotient(scatter)};
}

}  // namespace dynlab::test
