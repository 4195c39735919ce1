#include "figures/plots/order_plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "figures/panel_axes.h"
#include "numerics/error.h"

namespace test_order_plot {

using namespace dynlab;

OrderCandidate candidate(int poles, int zeros, double delay, double bic) {
    OrderCandidate one;
    one.poles = poles;
    one.zeros = zeros;
    one.delay = delay;
    one.bic = bic;
    return one;
}

TEST(order_plot, a_curve_for_each_number_of_zeros) {  // oracle: the candidates themselves
    OrderSelection selection;
    selection.candidates = {candidate(1, 0, 0, 3), candidate(2, 0, 0, 1), candidate(2, 0, 0.1, 0.5),
                            candidate(2, 1, 0, 1.5), candidate(3, 1, 0, 2)};
    selection.candidates[4].failure = Message("no luck");
    const Figure figure = order_plot(selection, OrderCriterion::kBic, {2, {}});
    figure.validate();
    const Panel& panel = figure.panels.front();
    ASSERT_EQ(panel.curves.size(), 3u);  // no zero, one zero, the chosen one
    EXPECT_EQ(panel.curves[0].x, (Vector{{1, 2}}));
    EXPECT_EQ(panel.curves[0].y, (Vector{{3, 0.5}}));  // the better of two delays
    EXPECT_EQ(panel.curves[1].y, Vector::Constant(1, 1.5));
    EXPECT_EQ(panel.curves[2].y, Vector::Constant(1, 0.5));
    for (const double width : {12.0, 3.0, 1.5}) {  // there is no half a pole, whatever the room
        Axis x, y;
        choose_axes(panel, width, 4, x, y);
        ASSERT_EQ(x.ticks.size(), 2u);
        EXPECT_EQ(x.ticks[0].label, "1");
        EXPECT_EQ(x.ticks[1].label, "2");
    }
}

TEST(order_plot, over_the_delay_when_nothing_else_differs) {
    OrderSelection selection;
    selection.candidates = {candidate(2, 0, 0, 3), candidate(2, 0, 0.1, 1), candidate(2, 0, 0.2, 2)};
    const Figure figure = order_plot(selection, OrderCriterion::kRecommended, {1, {}});
    EXPECT_EQ(figure.panels.front().curves[0].x, (Vector{{0, 0.1, 0.2}}));
    EXPECT_EQ(message_text(figure.panels.front().x_label), "delay (s)");
    EXPECT_THROW(order_plot(selection, OrderCriterion::kValidationFit, {1, {}}), InvalidArgument);
    for (OrderCandidate& one : selection.candidates) one.failure = Message("no luck");
    EXPECT_THROW(order_plot(selection, OrderCriterion::kBic, {1, {}}), InvalidArgument);
}

}  // namespace test_order_plot
