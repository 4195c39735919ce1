#include "figures/plots/delay_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/error.h"

namespace test_delay_plot {

using namespace dynlab;
using testing::HasSubstr;

DelaySearch search() {
    DelaySearch one;
    one.delay = 0.23;
    one.std = 0.011;
    one.candidate.estimate.loss = 0.4;
    one.candidate.estimate.delay_grid = Vector{{0, 0.1, 0.2, 0.3}};
    one.candidate.estimate.delay_loss = Vector{{0.6, 1, 0.5, 0.7}};
    return one;
}

TEST(delay_plot, shows_the_curve_and_the_estimate) {  // oracle: the search itself
    const Figure figure = delay_plot(search());
    figure.validate();
    const Panel& panel = figure.panels.front();
    ASSERT_EQ(panel.curves.size(), 2u);
    EXPECT_EQ(panel.curves[0].x, (Vector{{0, 0.1, 0.2, 0.3}}));
    EXPECT_EQ(panel.curves[0].y, (Vector{{0.6, 1, 0.5, 0.7}}));
    EXPECT_EQ(panel.curves[1].x[0], 0.23);
    EXPECT_EQ(panel.curves[1].y[0], 0.4);
    EXPECT_THAT(message_text(panel.curves[1].label), HasSubstr("0.230 ± 0.011 s"));
    EXPECT_LT(panel.y_range->first, 0.4);
}

TEST(delay_plot, writes_no_digits_below_the_error) {  // oracle: rounding by hand
    DelaySearch one = search();
    const auto label = [&one](double delay, double error) {
        one.delay = delay;
        one.std = error;
        return message_text(delay_plot(one).panels.front().curves[1].label);
    };
    EXPECT_EQ(label(0.0057775, 0.00969), "estimate, 0.0058 ± 0.0097 s");
    EXPECT_EQ(label(12.3456, 1.23), "estimate, 12.3 ± 1.2 s");
    EXPECT_EQ(label(0.16, std::nan("")), "estimate, 0.16 s");
    EXPECT_EQ(label(1234.7, 321), "estimate, 1235 ± 321 s");
    EXPECT_EQ(label(0.16, 0), "estimate, 0.16 ± 0 s");
}

TEST(delay_plot, marks_a_rival_on_the_curve) {
    DelaySearch with_rival = search();
    with_rival.rival = 0;
    const Panel panel = delay_plot(with_rival).panels.front();
    ASSERT_EQ(panel.curves.size(), 3u);
    EXPECT_EQ(panel.curves[2].y[0], 0.6);
}

TEST(delay_plot, refuses_a_search_that_was_stopped) {
    DelaySearch stopped;
    stopped.canceled = true;
    EXPECT_THROW(delay_plot(stopped), InvalidArgument);
}

}  // namespace test_delay_plot
