#include "figures/plots/monte_carlo_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "figures/histogram.h"
#include "numerics/error.h"
#include "numerics/signals/random.h"
#include "support/thrown_message.h"

namespace test_monte_carlo_plot {

using namespace dynlab;
using testing::HasSubstr;

MonteCarloResult normal_result(const std::string& label, double bias, std::uint32_t seed) {
    constexpr Index kRuns = 500;
    MonteCarloResult result;
    result.label = label;
    result.names = {"a1", "b0"};
    RandomStream random(seed);
    result.theta.resize(kRuns, 2);
    for (Index k = 0; k < kRuns; ++k) {
        const double first = random.normal();
        result.theta(k, 0) = 4 + bias + 0.2 * first;
        result.theta(k, 1) = 2 + 0.1 * (0.8 * first + 0.6 * random.normal());
    }
    result.std = Matrix::Constant(kRuns, 2, 0.1);
    result.truth = Vector{{4, 2}};
    result.bound = Matrix{{0.04, 0.016}, {0.016, 0.01}};
    result.estimated = kRuns;
    return result;
}

MonteCarlo study() {
    MonteCarlo all;
    all.results = {normal_result("good", 0, 1), normal_result("biased", -0.6, 2)};
    return all;
}

TEST(monte_carlo_plot, histograms_hold_every_run_and_the_truth) {  // oracle: counting
    const Figure figure = monte_carlo_histograms(study());
    figure.validate();
    EXPECT_EQ(figure.rows, 2);
    EXPECT_EQ(figure.columns, 2);
    ASSERT_EQ(figure.panels.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Panel& panel = figure.panels[i];
        EXPECT_EQ(panel.curves.front().y.sum(), 500);
        EXPECT_EQ(panel.references.front().at, i % 2 == 0 ? 4 : 2);
        EXPECT_EQ(message_text(panel.x_label), i < 2 ? "" : i == 2 ? "a_{1}" : "b_{0}");
        EXPECT_EQ(panel.x_range, figure.panels[i % 2].x_range);  // methods share a column's range
    }
}

TEST(monte_carlo_plot, far_estimates_do_not_squeeze_the_rest) {
    MonteCarlo all = study();
    all.results.front().theta(7, 0) = 1e4;
    const Figure figure = monte_carlo_histograms(all);
    EXPECT_LT(figure.panels.front().x_range->second, 10);
    EXPECT_EQ(figure.panels.front().curves.front().y.sum(), 499);
    EXPECT_EQ(message_text(figure.panels[0].title), "1 of 500 outside the axes");
    EXPECT_EQ(message_text(figure.panels[1].title), "");
}

/// Where a method diverges in a tenth of all runs the others are still to be seen, and what is not shown is counted.
TEST(monte_carlo_plot, many_far_estimates_do_not_squeeze_the_rest) {  // oracle: counting
    MonteCarlo all = study();
    for (Index k = 0; k < 50; ++k) all.results.front().theta.row(k) << 1e5 + static_cast<double>(k), 1e6;
    const Panel panel = monte_carlo_scatter(all, "a1", "b0").panels.front();
    EXPECT_LT(panel.x_range->second, 20);
    EXPECT_LT(panel.y_range->second, 10);
    EXPECT_EQ(message_text(panel.title), "50 of 1000 outside the axes");
    EXPECT_EQ(message_text(monte_carlo_histograms(all).panels.front().title), "50 of 500 outside the axes");
}

TEST(monte_carlo_plot, failed_runs_are_left_out) {
    MonteCarlo all = study();
    all.results.front().theta.row(3).setConstant(std::nan(""));
    EXPECT_EQ(monte_carlo_histograms(all).panels.front().curves.front().y.sum(), 499);
    EXPECT_EQ(monte_carlo_scatter(all, "a1", "b0").panels.front().curves.front().x.size(), 499);
}

TEST(monte_carlo_plot, indices_of_parameters_are_lowered) {  // oracle: how the names are written by hand
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"b10", "b_{10}"},     {"Kp", "K_{p}"},  {"Tp1", "T_{p1}"}, {"b0_u2", "b_{0,u2}"},
        {"Td_u1", "T_{d,u1}"}, {"Zeta", "Zeta"}, {"Tau", "Tau"},    {"my gain", "my gain"}};
    for (const auto& [name, symbol] : cases) {
        MonteCarlo all = study();
        for (MonteCarloResult& result : all.results) result.names.front() = name;
        EXPECT_EQ(monte_carlo_scatter(all, name, "b0").panels.front().x_label, Message::verbatim(symbol));
    }
}

TEST(monte_carlo_plot, ellipse_holds_its_share_of_efficient_estimates) {
    // Oracle: Gaussian estimates with the bound's covariance; 95 % of 500 within four standard deviations of the count.
    const MonteCarlo all = study();
    const Panel panel = monte_carlo_scatter(all, "a1", "b0", 0.95).panels.front();
    ASSERT_EQ(panel.curves.size(), 4u);  // two clouds, ellipse, truth
    const Curve& ellipse = panel.curves[2];
    const Matrix inverse = Matrix{{0.01, -0.016}, {-0.016, 0.04}} / (0.04 * 0.01 - 0.016 * 0.016);
    const auto distance = [&](double x, double y) {
        const Vector v{{x - 4, y - 2}};
        return v.dot(inverse * v);
    };
    const double radius = distance(ellipse.x[0], ellipse.y[0]);
    for (Index i = 0; i < ellipse.x.size(); ++i) EXPECT_NEAR(distance(ellipse.x[i], ellipse.y[i]), radius, 1e-9);
    int inside = 0;
    for (Index k = 0; k < 500; ++k) inside += distance(all.results[0].theta(k, 0), all.results[0].theta(k, 1)) < radius;
    EXPECT_NEAR(inside, 475, 4 * std::sqrt(500 * 0.95 * 0.05));
}

TEST(monte_carlo_plot, refuses_what_it_cannot_draw) {
    const MonteCarlo all = study();
    EXPECT_THAT(thrown_message([&] { monte_carlo_scatter(all, "a1", "Td"); }), HasSubstr("no parameter 'Td'"));
    EXPECT_THROW(monte_carlo_scatter(all, "a1", "a1"), InvalidArgument);
    EXPECT_THROW(monte_carlo_scatter(all, "a1", "b0", 1), InvalidArgument);
    EXPECT_THROW(monte_carlo_histograms(MonteCarlo{}), InvalidArgument);
    MonteCarlo mixed = study();
    mixed.results.back().names = {"a1", "b1"};
    EXPECT_THAT(thrown_message([&] { monte_carlo_histograms(mixed); }), HasSubstr("different parameters"));
}

}  // namespace test_monte_carlo_plot
