#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "figures/plots/compare_plot.h"
#include "figures/plots/pole_zero_map.h"
#include "figures/plots/regression_plot.h"
#include "figures/step_construction.h"
#include "numerics/error.h"

namespace test_standard_plots {

using namespace dynlab;
using testing::HasSubstr;

const Curve& curve_called(const Figure& figure, const std::string& label) {
    for (const Curve& curve : figure.panels[0].curves)
        if (message_text(curve.label) == label) return curve;
    throw std::runtime_error("no curve " + label);
}

TEST(compare_plot, a_lost_run_leaves_the_axis_to_the_others) {  // oracle: the range of the measured values, 1 to 3
    const Vector y{{1, 3, 2}}, u = Vector::Ones(3), lost{{1, 1e6, kNaN}};
    const Figure figure = compare_plot(
        IdData(Matrix(y), Matrix(u), 1),
        {{Message("a"), y, Vector::Constant(1, 100)}, {Message("b"), lost, Vector::Constant(1, -kInfinity)}});
    EXPECT_EQ(curve_called(figure, "b: unstable").y[1], 1e6);
    EXPECT_EQ(curve_called(figure, "a: 100.0 %").y[1], 3);
    EXPECT_EQ(figure.panels[0].y_range, std::pair(0.5, 3.5));
}

// Oracle: roots by hand, 1/((s + 1)(s + 2)).
TEST(pole_zero_map, shows_every_pole_inside_the_axes) {
    const Figure figure = pole_zero_map({{{}, TransferFunction(Vector{{1.0}}, Vector{{1.0, 3.0, 2.0}})}});
    figure.validate();
    Vector real = curve_called(figure, "poles").x;
    std::sort(real.begin(), real.end());
    EXPECT_NEAR((real - Vector{{-2, -1}}).norm(), 0, 1e-10);
    EXPECT_LT(figure.panels[0].x_range->first, -2);
    EXPECT_GT(figure.panels[0].x_range->second, 0);
}

// Oracle: a discrete pole on a damping spiral has that damping ratio, -Re(log z)/|log z|.
TEST(pole_zero_map, spirals_have_their_damping_ratio) {
    const Figure figure = pole_zero_map({{{}, TransferFunction(Vector{{1.0}}, Vector{{1.0, -0.5}}, 0.1)}});
    std::vector<double> ratios;
    for (const Curve& curve : figure.panels[0].curves) {
        if (!curve.label.empty()) continue;
        const Complex logarithm = std::log(Complex(curve.x[40], curve.y[40]));
        ratios.push_back(-logarithm.real() / std::abs(logarithm));
    }
    using testing::DoubleNear;
    EXPECT_THAT(ratios,
                testing::UnorderedElementsAre(DoubleNear(0, 1e-9), DoubleNear(0.2, 1e-9), DoubleNear(0.2, 1e-9),
                                              DoubleNear(0.4, 1e-9), DoubleNear(0.4, 1e-9), DoubleNear(0.6, 1e-9),
                                              DoubleNear(0.6, 1e-9), DoubleNear(0.8, 1e-9), DoubleNear(0.8, 1e-9)));
}

TEST(pole_zero_map, refuses_nothing_and_mixtures) {
    const TransferFunction gain(Vector{{2.0}}, Vector{{1.0}});
    const TransferFunction slow(Vector{{1.0}}, Vector{{1.0, 1.0}}), discrete(Vector{{1.0}}, Vector{{1.0, 0.5}}, 0.1);
    EXPECT_THROW(pole_zero_map({}), InvalidArgument);
    EXPECT_THROW(pole_zero_map({{Message("gain"), gain}}), InvalidArgument);
    EXPECT_THROW(pole_zero_map({{Message("a"), slow}, {Message("b"), discrete}}), InvalidArgument);
}

TEST(regression_plot, refuses_bands_that_do_not_fit_the_line) {
    RegressionPicture picture;
    picture.line_x = picture.line_y = Vector::LinSpaced(5, 0, 1);
    picture.confidence_lower = picture.confidence_upper = Vector::Zero(4);
    EXPECT_THROW(regression_plot(picture), InvalidArgument);
}

// Oracle: 1 - exp(-t/T) by hand; the band is 5 % of the change, not of the level, and times count from the step.
TEST(step_construction, draws_the_band_of_the_change_and_times_from_the_step) {
    StepConstruction input;
    input.t = Vector::LinSpaced(101, 0, 50);
    input.y = 20 + 10 * (1 - (-(input.t.array() - 10).max(0) / 5).exp());
    input.step_time = 10;
    input.initial = 20, input.final = 30;
    input.readings = {{"settling", 25, 29.5}};
    const Figure figure = step_construction(input);
    figure.validate();
    const Curve& band = curve_called(figure, "±5 % band");
    EXPECT_NEAR(band.y[0], 29.5, 1e-12);
    EXPECT_NEAR(band.y_upper[0], 30.5, 1e-12);
    ASSERT_EQ(figure.panels[0].arrows.size(), 2u);
    const Arrow &gain = figure.panels[0].arrows[0], &time = figure.panels[0].arrows[1];
    EXPECT_EQ(message_text(gain.text), "K Δu");
    EXPECT_EQ(gain.x0, gain.x1);
    EXPECT_EQ(gain.y1 - gain.y0, 10) << "from level to level";
    EXPECT_THAT(message_text(time.text), HasSubstr("= 15 s"));
    EXPECT_NEAR(time.x1 - time.x0, 15, 1e-12);
}

}  // namespace test_standard_plots
