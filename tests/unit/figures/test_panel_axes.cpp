// Oracle: what a reader needs of an axis, over frames and ranges of many sizes.
#include "figures/panel_axes.h"

#include <gtest/gtest.h>

#include "figures/style.h"

namespace test_panel_axes {

using namespace dynlab;

constexpr double kWidths[] = {1.6, 2, 2.5, 3, 5, 12}, kHeights[] = {0.8, 1.2, 2, 4, 8};

Panel panel_over(std::pair<double, double> x, std::pair<double, double> y, bool log = false) {
    Panel panel;
    panel.x_range = x;
    panel.y_range = y;
    panel.log_x = panel.log_y = log;
    return panel;
}

void expect_readable(const Panel& panel) {
    for (const double width : kWidths)
        for (const double height : kHeights) {
            Axis x, y;
            choose_axes(panel, width, height, x, y);
            EXPECT_GE(x.ticks.size(), 2u) << width << " cm from " << x.low << " to " << x.high;
            EXPECT_GE(y.ticks.size(), 2u) << height << " cm from " << y.low << " to " << y.high;
            for (std::size_t i = 1; i < x.ticks.size(); ++i) {
                const double spacing = (x.position(x.ticks[i].value) - x.position(x.ticks[i - 1].value)) * width;
                const double expected = 0.5 * (text_width(x.ticks[i].label, style::kTickSize) +
                                               text_width(x.ticks[i - 1].label, style::kTickSize));
                EXPECT_GT(spacing, expected) << x.ticks[i].label << " in " << width << " cm";
            }
        }
}

TEST(panel_axes, narrow_axes_show_two_numbers_that_do_not_touch) {
    for (const auto& range : {std::pair{0.0, 1.0}, {0.32, 0.68}, {3.42, 3.97}, {-0.31, 0.09}, {1.9, 2.1}, {-7.0, 61.0}})
        expect_readable(panel_over(range, range));
}

TEST(panel_axes, logarithmic_axes_too) {
    for (const auto& range : {std::pair{0.3, 8.0}, {0.02, 0.9}, {1.0, 2.0}, {1e-3, 1e4}})
        expect_readable(panel_over(range, range, true));
}

TEST(panel_axes, a_wanted_step_is_thinned_but_never_divided) {
    Panel panel = panel_over({0.5, 12.5}, {0, 1});
    panel.x_tick_step = 1;
    for (const double width : kWidths) {
        Axis x, y;
        choose_axes(panel, width, 4, x, y);
        EXPECT_GE(x.ticks.size(), 2u);
        for (const Tick& tick : x.ticks) EXPECT_EQ(tick.label.find('.'), std::string::npos) << tick.label;
    }
}

TEST(panel_axes, edges_of_bars_are_numbers) {
    const Vector centers{{-1.7e308, 0, 1.7e308}};
    for (const Index i : {0, 1, 2}) {
        const auto [left, right] = bar_edges(centers, i);
        EXPECT_TRUE(std::isfinite(left) && std::isfinite(right)) << i;
        EXPECT_LT(left, right);
    }
}

}  // namespace test_panel_axes
