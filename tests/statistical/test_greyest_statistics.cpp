#include <gtest/gtest.h>

#include <cmath>

#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "support/grey_cases.h"

namespace test_greyest_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kDataSets = 500;
constexpr double kTs = 0.05, kPositionNoise = 5e-4, kAngleNoise = 3e-3;

// Oracle: statistics with fixed seeds. The crane's equations with six unknowns, white noise on position and angle: of
// the 95 % intervals between 92 and 98 % hold the truth.
TEST(greyest_statistics, intervals_hold_the_truth_as_often_as_they_say) {
    const Vector truth{{1.01, 14.6, 0.25, 0.055, 0.372, 0.04, 0.012}};
    GreyModel model = crane_model();
    for (std::size_t i = 0; i < model.parameters.size(); ++i)
        model.parameters[i].start = truth[static_cast<Index>(i)] * 1.02;
    model.parameters[6].fixed = true;
    model.parameters[6].start = truth[6];
    const Vector u = 2 * prbs(4, 5);
    const Vector t = kTs * Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1));
    const Matrix clean = GreySimulator(model, 2, {}, 1e-8).run(truth, {Matrix(u), t}, {}, false).y;
    GreyOptions options;
    options.relative_tolerance = 1e-5;
    options.tolerance = 1e-3;
    options.output_weights = Vector{{1 / kPositionNoise, 1 / kAngleNoise}};
    Vector inside = Vector::Zero(6);
    for (int run = 0; run < kDataSets; ++run) {
        RandomStream random(static_cast<std::uint32_t>(run + 1));
        Matrix y = clean;
        y.col(0) += kPositionNoise * random.normal(u.size());
        y.col(1) += kAngleNoise * random.normal(u.size());
        const GreyFit found = greyest(IdData(y, Matrix(u), kTs), model, options);
        for (Index i = 0; i < 6; ++i)
            inside[i] += found.intervals(i, 0) <= truth[i] && truth[i] <= found.intervals(i, 1) ? 1. / kDataSets : 0;
    }
    for (Index i = 0; i < 6; ++i) {
        EXPECT_GE(inside[i], 0.92) << model.parameters[static_cast<std::size_t>(i)].name;
        EXPECT_LE(inside[i], 0.98) << model.parameters[static_cast<std::size_t>(i)].name;
    }
}

}  // namespace test_greyest_statistics
