// Oracle: the truth. 500 records of a loop with coloured noise: the means of consistent methods lie within three
// standard errors of it, those of the direct least squares are off by more than ten, but for a2.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/closed_loop/clivsvf.h"
#include "numerics/estimators/closed_loop/clsrivc.h"
#include "support/loop_cases.h"

namespace test_closed_loop_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kRecords = 500;
constexpr double kSigma = 0.03;
const TransferStructure kPlant = TransferStructure::single(2, 0);
const Vector kTruth = values({4, 3, 2});

struct Study {
    Vector bias;      ///< in standard errors of the mean
    Vector reported;  ///< root mean square of the standard errors, relative to the scatter
};

template <class Method>
Study study_of(const Method& method) {
    Matrix theta(kRecords, 3), std(kRecords, 3);
    for (int k = 0; k < kRecords; ++k) {
        const Fit fit = method(loop_record(kSigma, static_cast<std::uint32_t>(k + 1)));
        theta.row(k) = fit.theta.transpose();
        std.row(k) = fit.std.transpose();
    }
    const Vector mean = theta.colwise().mean();
    const Vector scatter =
        ((theta.rowwise() - mean.transpose()).colwise().squaredNorm().transpose() / (kRecords - 1)).cwiseSqrt();
    return {(mean - kTruth).cwiseQuotient(scatter / std::sqrt(double(kRecords))),
            (std.colwise().squaredNorm().transpose() / kRecords).cwiseSqrt().cwiseQuotient(scatter)};
}

SvfOptions cutoff() {
    SvfOptions options;
    options.lambda = 4;
    return options;
}

FitOptions refined() {
    FitOptions options;
    options.lambda = 4;
    return options;
}

void expect_consistent(const Study& study, const char* what) {
    EXPECT_LT(study.bias.cwiseAbs().maxCoeff(), 3) << what << " " << study.bias.transpose();
    EXPECT_NEAR(study.reported.minCoeff(), 1, 0.15) << what << " " << study.reported.transpose();
    EXPECT_NEAR(study.reported.maxCoeff(), 1, 0.15) << what << " " << study.reported.transpose();
}

TEST(closed_loop_statistics, direct_least_squares_is_biased) {
    const Study study = study_of([](const IdData& data) { return lssvf(data, kPlant, cutoff()); });
    EXPECT_LT(study.bias[0], -10) << study.bias.transpose();
    EXPECT_LT(study.bias[2], -10) << study.bias.transpose();
}

TEST(closed_loop_statistics, clivsvf_is_consistent) {
    expect_consistent(study_of([](const IdData& data) { return clivsvf(data, kPlant, cutoff(), {loop_controller()}); }),
                      "known controller");
}

TEST(closed_loop_statistics, clivsvf_is_consistent_without_a_controller) {
    expect_consistent(study_of([](const IdData& data) { return clivsvf(data, kPlant, cutoff()); }),
                      "unknown controller");
}

TEST(closed_loop_statistics, clsrivc_is_consistent) {
    expect_consistent(
        study_of([](const IdData& data) { return clsrivc(data, kPlant, refined(), {loop_controller()}); }),
        "known controller");
}

TEST(closed_loop_statistics, the_indirect_route_is_consistent) {
    expect_consistent(study_of([](const IdData& data) {
                          return clsrivc(data, kPlant, refined(), {loop_controller()}, LoopRoute::kIndirect);
                      }),
                      "indirect");
}

TEST(closed_loop_statistics, the_two_stage_route_is_consistent) {
    const Study study =
        study_of([](const IdData& data) { return clsrivc(data, kPlant, refined(), {}, LoopRoute::kTwoStage); });
    EXPECT_LT(study.bias.cwiseAbs().maxCoeff(), 3) << study.bias.transpose();
}

}  // namespace test_closed_loop_statistics
