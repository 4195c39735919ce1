#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/plots/history_plot.h"
#include "support/thrown_message.h"

namespace test_history_plot {

using namespace dynlab;
using testing::HasSubstr;

TEST(history_plot, has_a_panel_with_band_and_truth_for_each_parameter) {  // oracle: the history itself
    ParameterHistory history{Vector::LinSpaced(9, 0, 8), Matrix::Constant(9, 2, 3), Matrix::Constant(9, 2, 0.1)};
    history.theta.row(0).setConstant(kNaN);
    const Figure figure = history_plot(history, {"a1", "b0"}, {{"b0", Vector::LinSpaced(5, 2, 4)}}, 0.95);
    ASSERT_EQ(figure.panels.size(), 2u);
    const auto band_of = [](const Panel& panel) {
        for (const Curve& curve : panel.curves)
            if (curve.style == CurveStyle::kBand) return curve;
        return Curve();
    };
    EXPECT_NEAR(band_of(figure.panels[0]).y_upper[4] - band_of(figure.panels[0]).y[4], 2 * 1.959964 * 0.1, 1e-5);
    EXPECT_EQ(figure.panels[1].curves.size(), figure.panels[0].curves.size() + 1);
    EXPECT_LT(figure.panels[1].y_range->first, 2);
    EXPECT_GT(figure.panels[1].y_range->second, 4);
    EXPECT_THAT(thrown_message([&] {
                    history_plot(history, {"a1", "b0"}, {{"K", Vector::Ones(1)}});
                }),
                HasSubstr("the parameters are a1, b0"));
}

}  // namespace test_history_plot
