// Oracle: studies by independent programs with the same random numbers (tests/reference/data/README.md), and the
// Cramer-Rao bound.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/validation/monte_carlo.h"
#include "support/transfer_cases.h"

namespace test_monte_carlo_statistics {

using namespace dynlab;
using namespace dynlab::test;

nlohmann::json reference_study(const std::string& name) {
    std::ifstream stream(std::string(DYNLAB_SOURCE_DIR) + "/tests/reference/data/" + name + ".json");
    return nlohmann::json::parse(stream);
}

MonteCarloEstimate estimate_of(const Fit& result) {
    return {result.theta, result.std, result.names, true, result.termination == Termination::kConverged};
}

template <auto kMethod>
MonteCarloMethod filtered(const std::string& label, int poles, int zeros, double lambda, Hold hold_y = Hold::kFoh) {
    return {label, [=](const IdData& data) {
                SvfOptions options;
                options.lambda = lambda;
                options.hold_y = hold_y;
                return estimate_of(kMethod(data, TransferStructure::single(poles, zeros), options));
            }};
}

/// `label` is the method's name in the references: "oe" for coe.
template <auto kMethod>
MonteCarloMethod refined(const std::string& label, int poles, int zeros, const FitOptions& options) {
    return {label, [=](const IdData& data) {
                return estimate_of(kMethod(data, TransferStructure::single(poles, zeros), options, {}));
            }};
}

FitOptions exact_options(double lambda) {
    FitOptions options = FitOptions{}.from_rest();
    options.lambda = lambda;
    options.tolerance = 1e-10;
    return options;
}

MonteCarloStudy course_study(double sigma) {
    return {TransferFunction(Vector{{2}}, Vector{{1, 4, 3}}), prbs(4, 100), 0.01, Hold::kZoh, sigma, {}, 200, 1};
}

MonteCarloStudy rao_garnier_study(double snr) {
    return {TransferFunction(Vector{{-6400, 1600}}, Vector{{1, 5, 408, 416, 1600}}),
            prbs(10, 7),
            0.01,
            Hold::kZoh,
            {},
            snr,
            200,
            1};
}

/// Mean, standard deviation, median and extremes.
void expect_same_statistics(const MonteCarloResult& result, const nlohmann::json& reference) {
    SCOPED_TRACE(result.label);
    ASSERT_EQ(result.failed, 0);
    const std::pair<const char*, const Vector*> statistics[] = {{"mean", &result.mean},
                                                                {"std", &result.spread},
                                                                {"median", &result.median},
                                                                {"min", &result.low},
                                                                {"max", &result.high}};
    for (const auto& [name, values] : statistics) {
        const auto expected = reference.at(name).get<std::vector<double>>();
        ASSERT_EQ(values->size(), static_cast<Index>(expected.size()));
        for (Index i = 0; i < values->size(); ++i) {
            const double value = expected[static_cast<std::size_t>(i)];
            EXPECT_NEAR((*values)[i], value, 1e-6 * std::abs(value)) << name << " of parameter " << i;
        }
    }
}

void expect_honest_errors(const MonteCarloResult& result) {
    for (Index i = 0; i < result.mean.size(); ++i) {
        EXPECT_NEAR(result.reported[i] / result.spread[i], 1, 0.1) << result.names[static_cast<std::size_t>(i)];
        EXPECT_NEAR(result.spread[i] / result.least_spread()[i], 1, 0.2) << result.names[static_cast<std::size_t>(i)];
    }
}

void compare_course_study(double sigma, const std::string& reference_name) {
    std::vector<MonteCarloMethod> methods;
    for (const char* lambda : {"0.3", "2", "3", "30"}) {
        methods.push_back(filtered<lssvf>(std::string("lssvf_lambda") + lambda + "_yfoh", 2, 0, std::atof(lambda)));
        methods.push_back(filtered<ivsvf>(std::string("ivsvf_lambda") + lambda + "_yfoh", 2, 0, std::atof(lambda)));
    }
    methods.push_back(filtered<lssvf>("lssvf_lambda3_yzoh", 2, 0, 3, Hold::kZoh));
    methods.push_back(filtered<ivsvf>("ivsvf_lambda3_yzoh", 2, 0, 3, Hold::kZoh));
    methods.push_back(refined<srivc>("srivc", 2, 0, exact_options(3)));
    methods.push_back(refined<coe>("oe", 2, 0, exact_options(3)));
    const MonteCarlo study = monte_carlo(course_study(sigma), methods);
    const nlohmann::json reference = reference_study(reference_name).at("stats");
    for (const MonteCarloResult& result : study.results) expect_same_statistics(result, reference.at(result.label));
    const auto reported = reference.at("srivc_se").at("mean").get<std::vector<double>>();
    for (std::size_t j = study.results.size() - 2; j < study.results.size(); ++j) {
        const MonteCarloResult& result = study.results[j];
        expect_honest_errors(result);
        EXPECT_EQ(result.not_converged, 0) << result.label;
        for (Index i = 0; i < 3; ++i)
            EXPECT_NEAR(result.reported[i], reported[static_cast<std::size_t>(i)], 1e-6) << result.label << i;
    }
}

TEST(monte_carlo_statistics, course_system_with_sigma_02) {
    compare_course_study(0.2, "mc_sys2_0.2");
}

TEST(monte_carlo_statistics, course_system_with_sigma_04) {
    compare_course_study(0.4, "mc_sys2_0.4");
}

TEST(monte_carlo_statistics, rao_garnier_at_10_dB) {
    const MonteCarlo study = monte_carlo(
        rao_garnier_study(10),
        {filtered<lssvf>("lssvf_yfoh", 4, 1, 25), filtered<ivsvf>("ivsvf_yfoh", 4, 1, 25),
         filtered<lssvf>("lssvf_yzoh", 4, 1, 25, Hold::kZoh), filtered<ivsvf>("ivsvf_yzoh", 4, 1, 25, Hold::kZoh),
         refined<srivc>("srivc", 4, 1, exact_options(25)), refined<coe>("oe", 4, 1, exact_options(25))});
    const nlohmann::json reference = reference_study("mc_rg");
    EXPECT_NEAR(study.sigma, reference.at("sigma").get<double>(), 1e-9);
    for (const MonteCarloResult& result : study.results)
        expect_same_statistics(result, reference.at("stats").at(result.label));
    expect_honest_errors(study.results[4]);
    expect_honest_errors(study.results[5]);
}

/// Runs of srivc from default settings whose loss is within 1 % of the loss at the true parameters, or below.
int good_fits(double snr) {
    const MonteCarloStudy study = rao_garnier_study(snr);
    const Vector x = lsim(study.system, study.u, study.Ts);
    const MonteCarlo result = monte_carlo(
        study, {{"loss ratio", [&](const IdData& data) {
                     const Fit estimate = srivc(data, TransferStructure::single(4, 1), FitOptions{}.from_rest());
                     const auto y = data.experiments.front().y.col(0);
                     const Vector simulated = lsim(estimate.models.front(), study.u, study.Ts);
                     return MonteCarloEstimate{Vector{{(y - simulated).squaredNorm() / (y - x).squaredNorm()}}, {}};
                 }}});
    EXPECT_EQ(result.results.front().failed, 0);
    return static_cast<int>((result.results.front().theta.col(0).array() < 1.01).count());
}

TEST(monte_carlo_statistics, rao_garnier_is_found_from_default_settings) {
    EXPECT_EQ(good_fits(10), 200);
    EXPECT_GE(good_fits(0), 196);
}

}  // namespace test_monte_carlo_statistics
