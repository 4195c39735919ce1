// How often intervals contain the true value. Oracle: the simulated system, 500 data sets of 124 samples with seeds
// 1..500; the share of a 95 % interval has a standard error of 1 %.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/validation/intervals/bootstrap.h"
#include "numerics/validation/intervals/profile_likelihood.h"

namespace test_interval_statistics {

using namespace dynlab;

constexpr int kDataSets = 500;
constexpr double kTs = 0.1;

Vector input() {
    return prbs(5, 4);
}

RefittedOutput simulated_data(const FittedOutput& truth, double noise, int seed) {
    const Vector u = input(), x = lsim(truth.model(), u, kTs);
    const Vector y = x + noise * RandomStream(static_cast<std::uint32_t>(seed)).normal(u.size());
    return RefittedOutput(IdData(Matrix(y), Matrix(u), kTs), truth);
}

struct Coverage {
    int inside = 0;
    double percent() const { return 100.0 * inside / kDataSets; }
};

/// In per cent, of the intervals of a1, b0, the gain and the time constant.
Vector bootstrap_coverage(BootstrapKind kind) {
    const FittedOutput truth{TransferStructure::single(1, 0), {}, Vector{{1.5, 2}}};
    const Vector values{{1.5, 2, 2 / 1.5, 1 / 1.5}};
    Vector inside = Vector::Zero(4);
    for (int seed = 1; seed <= kDataSets; ++seed) {
        BootstrapOptions options;
        options.kind = kind;
        options.runs = 120;
        options.seed = static_cast<std::uint32_t>(1000 * seed);
        const Bootstrap found = bootstrap(simulated_data(truth, 0.5, seed), options);
        for (Index i = 0; i < 4; ++i) inside[i] += found.low[i] <= values[i] && values[i] <= found.high[i];
    }
    return 100 * inside / kDataSets;
}

TEST(interval_statistics, residual_bootstrap_holds_the_truth) {
    const Vector percent = bootstrap_coverage(BootstrapKind::kResidual);
    EXPECT_GE(percent.minCoeff(), 92);
    EXPECT_LE(percent.maxCoeff(), 98);
}

TEST(interval_statistics, parametric_bootstrap_holds_the_truth) {
    const Vector percent = bootstrap_coverage(BootstrapKind::kParametric);
    EXPECT_GE(percent.minCoeff(), 92);
    EXPECT_LE(percent.maxCoeff(), 98);
}

double profile_coverage(const FittedOutput& truth, double noise, const std::string& name) {
    Coverage coverage;
    for (int seed = 1; seed <= kDataSets; ++seed) {
        ProfileOptions options;
        options.points = 9;
        const Profile found = profile_likelihood(simulated_data(truth, noise, seed), name, options);
        const double value = truth.theta[truth.place_of(name)];
        coverage.inside += (!found.low || *found.low <= value) && (!found.high || value <= *found.high);
    }
    return coverage.percent();
}

TEST(interval_statistics, profiles_of_time_constants_hold_the_truth) {
    const FittedOutput truth{{}, ProcessStructure::parse("P1"), Vector{{2, 0.7}}};
    const double percent = profile_coverage(truth, 0.5, "Tp1");
    EXPECT_GE(percent, 92);
    EXPECT_LE(percent, 98);
}

TEST(interval_statistics, profiles_of_delays_hold_the_truth) {
    const FittedOutput truth{{}, ProcessStructure::parse("P1D"), Vector{{2, 0.7, 0.33}}};
    const double percent = profile_coverage(truth, 0.5, "Td");
    EXPECT_GE(percent, 92);
    EXPECT_LE(percent, 98);
}

}  // namespace test_interval_statistics
