// Oracle: the truth. The means over 200 records with noise: recursive instrumental variables end within three standard
// errors of it, recursive least squares more than ten away.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/recursive/rivsvf.h"
#include "numerics/estimators/recursive/rlssvf.h"
#include "numerics/estimators/recursive/rsrivc.h"
#include "support/recursive_cases.h"

namespace test_recursive_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kRecords = 200;
const Vector kTruth = values({4, 3, 2});

/// 2/(s^2 + 4s + 3), prbs(7, 20), Ts = 0.05 s: every stretch of it excites the system.
IdData rich_record(std::uint32_t seed) {
    const Vector u = prbs(7, 20);
    const Vector y =
        lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05) + 0.1 * RandomStream(seed).normal(u.size());
    return IdData(Matrix(y), Matrix(u), 0.05);
}

struct Study {
    Vector bias;      ///< in standard errors of the mean
    Vector reported;  ///< root mean square of the standard errors, relative to the scatter
};

template <class Method>
Study study_of(const Method& method) {
    Matrix theta(kRecords, 3), std(kRecords, 3);
    for (int k = 0; k < kRecords; ++k) {
        const Fit fit =
            method(rich_record(static_cast<std::uint32_t>(k + 1)), TransferStructure::single(2, 0), recursive(3));
        theta.row(k) = fit.theta.transpose();
        std.row(k) = fit.std.transpose();
    }
    const Vector mean = theta.colwise().mean();
    const Vector scatter =
        ((theta.rowwise() - mean.transpose()).colwise().squaredNorm().transpose() / (kRecords - 1)).cwiseSqrt();
    return {(mean - kTruth).cwiseQuotient(scatter / std::sqrt(double(kRecords))),
            (std.colwise().squaredNorm().transpose() / kRecords).cwiseSqrt().cwiseQuotient(scatter)};
}

TEST(recursive_statistics, least_squares_are_biased) {
    const Vector bias = study_of(rlssvf).bias;
    EXPECT_GT(bias.cwiseAbs().minCoeff(), 10) << bias.transpose();
}

TEST(recursive_statistics, instrumental_variables_are_not) {
    const Vector bias = study_of(rivsvf).bias;
    EXPECT_LT(bias.cwiseAbs().maxCoeff(), 3) << bias.transpose();
}

TEST(recursive_statistics, refined_ones_are_not_either) {
    const Study study = study_of(rsrivc);
    EXPECT_LT(study.bias.cwiseAbs().maxCoeff(), 3) << study.bias.transpose();
    // Good to a factor of two, as the page says: the errors are weighed with the estimates of then.
    EXPECT_GT(study.reported.minCoeff(), 0.5) << study.reported.transpose();
    EXPECT_LT(study.reported.maxCoeff(), 2) << study.reported.transpose();
}

}  // namespace test_recursive_statistics
