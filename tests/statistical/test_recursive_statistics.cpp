// Oracle: the true values. The means over 200 data sets with noise: recursive instrumental variables end within three
// standard errors of the true values, recursive least squares more than ten away.
#include <gtest/gtest.h>

#include "numerics/estimators/recursive/rivsvf.h"
#include "numerics/estimators/recursive/rlssvf.h"
#include "numerics/estimators/recursive/rsrivc.h"
#include "support/estimator_study.h"
#include "support/recursive_cases.h"

namespace test_recursive_statistics {

using namespace dynlab;
using namespace dynlab::test;

constexpr int kDataSets = 200;
const Vector kTruth = values({4, 3, 2});

/// 2/(s^2 + 4s + 3), prbs(7, 20), Ts = 0.05 s: every stretch of it excites the system.
IdData rich_data(std::uint32_t seed) {
    const Vector u = prbs(7, 20);
    const Vector y =
        lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05) + 0.1 * RandomStream(seed).normal(u.size());
    return IdData(Matrix(y), Matrix(u), 0.05);
}

template <class Method>
EstimatorStudy study_with(const Method& method) {
    return study_of(kDataSets, kTruth, [&](std::uint32_t seed) {
        return method(rich_data(seed), TransferStructure::single(2, 0), recursive(3));
    });
}

TEST(recursive_statistics, least_squares_are_biased) {
    const Vector bias = study_with(rlssvf).bias;
    EXPECT_GT(bias.cwiseAbs().minCoeff(), 10) << bias.transpose();
}

/// The bias is within three standard errors, and the reported errors match the scatter.
void expect_consistent(const EstimatorStudy& study) {
    EXPECT_LT(study.bias.cwiseAbs().maxCoeff(), 3) << study.bias.transpose();
    EXPECT_GT(study.reported.minCoeff(), 0.7) << study.reported.transpose();
    EXPECT_LT(study.reported.maxCoeff(), 1.4) << study.reported.transpose();
}

TEST(recursive_statistics, instrumental_variables_are_not) {
    const EstimatorStudy study = study_with(rivsvf);
    expect_consistent(study);
    EXPECT_GT(study.reported.minCoeff(), 0.8) << study.reported.transpose();
    EXPECT_LT(study.reported.maxCoeff(), 1.2) << study.reported.transpose();
}

TEST(recursive_statistics, refined_ones_are_not_either) {
    expect_consistent(study_with(rsrivc));
}

/// Root mean square of errors in reported standard errors, over both parameters, the data sets and the history after 50
/// s.
template <class Method>
double errors_in_standard_errors(const Method& method, double forgetting, std::uint32_t data_sets) {
    const Vector truth = values({1.5, 2}), u = prbs(9, 8).head(4000);
    const Vector clean = lsim(TransferFunction(values({2}), values({1, 1.5})), u, 0.05);
    RecursiveOptions options = recursive(3);
    options.forgetting = forgetting;
    double squares = 0, count = 0;
    for (std::uint32_t seed = 1; seed <= data_sets; ++seed) {
        const IdData data(Matrix(clean + 0.1 * RandomStream(seed).normal(u.size())), Matrix(u), 0.05);
        const ParameterHistory history = *method(data, TransferStructure::single(1, 0), options).history;
        for (Index i = 0; i < history.t.size(); ++i) {
            if (history.t[i] <= 50) continue;
            squares += (history.theta.row(i) - truth.transpose()).cwiseQuotient(history.std.row(i)).squaredNorm();
            count += 2;
        }
    }
    return std::sqrt(squares / count);
}

TEST(recursive_statistics, standard_errors_match_the_scatter_of_any_memory) {
    for (const double forgetting : {0.95, 0.99, 0.999}) {
        const std::uint32_t data_sets =
            forgetting > 0.99 ? 60 : 20;  // hold more than a hundred independent values each
        EXPECT_NEAR(errors_in_standard_errors(rsrivc, forgetting, data_sets), 1, 0.15) << "rsrivc, " << forgetting;
        // The equation errors of rivsvf are colored, which makes it up to a quarter more precise than white errors
        // would. From so few blocks, it may detect half of that (product_color.h).
        const double errors = errors_in_standard_errors(rivsvf, forgetting, data_sets);
        EXPECT_GT(errors, 0.75) << "rivsvf, " << forgetting;
        EXPECT_LT(errors, 1.15) << "rivsvf, " << forgetting;
    }
}

}  // namespace test_recursive_statistics
