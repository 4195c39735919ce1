#include "figures/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "numerics/error.h"

namespace test_figure {

using namespace dynlab;
using testing::AllOf;
using testing::HasSubstr;

Figure figure_with(Vector x, Vector y) {
    Curve curve;
    curve.x = std::move(x);
    curve.y = std::move(y);
    curve.label = Message("measured");
    Panel panel;
    panel.title = Message("Outputs");
    panel.curves = {curve};
    return Figure(panel);
}

std::string complaint_of(const Figure& figure) {
    try {
        figure.validate();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "";
}

// Oracle: the contract of Figure::validate().
TEST(figure, sizes_that_differ_are_named_with_panel_and_curve) {
    EXPECT_THAT(complaint_of(figure_with(Vector::Zero(3), Vector::Zero(4))),
                AllOf(HasSubstr("Outputs"), HasSubstr("measured"), HasSubstr("3"), HasSubstr("4")));
}

TEST(figure, gaps_are_allowed_but_not_only_gaps) {
    const double nan = std::nan("");
    EXPECT_EQ(complaint_of(figure_with(Vector::LinSpaced(3, 0, 1), Vector{{1, nan, 2}})), "");
    EXPECT_THAT(complaint_of(figure_with(Vector::Zero(2), Vector{{nan, std::numeric_limits<double>::infinity()}})),
                HasSubstr("cannot be drawn"));
}

TEST(figure, ranges_must_run_upwards_and_be_positive_on_logarithmic_axes) {
    Figure figure = figure_with(Vector::Ones(2), Vector::Ones(2));
    figure.panels[0].x_range = {2.0, 1.0};
    EXPECT_THAT(complaint_of(figure), HasSubstr("x range"));
    figure.panels[0].x_range = {0.0, 1.0};
    EXPECT_EQ(complaint_of(figure), "");
    figure.panels[0].log_x = true;
    EXPECT_THAT(complaint_of(figure), HasSubstr("logarithmic"));
}

TEST(figure, negative_samples_alone_cannot_stand_on_a_logarithmic_axis) {
    Figure figure = figure_with(Vector::Ones(2), -Vector::Ones(2));
    figure.panels[0].log_y = true;
    EXPECT_THAT(complaint_of(figure), HasSubstr("positive"));
}

TEST(figure, more_panels_than_places_are_refused) {
    Figure figure = figure_with(Vector::Ones(2), Vector::Ones(2));
    figure.panels.push_back(figure.panels[0]);
    EXPECT_THAT(complaint_of(figure), HasSubstr("2 panels"));
    figure.columns = 2;
    EXPECT_EQ(complaint_of(figure), "");
}

}  // namespace test_figure
