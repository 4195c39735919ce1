#include "figures/plots/arx_order_plot.h"

#include <gtest/gtest.h>

#include "numerics/error.h"

namespace test_arx_order_plot {

using namespace dynlab;

ArxCandidate candidate(int na, int nb, double loss, double unseen) {
    ArxCandidate one;
    one.na = na;
    one.nb = nb;
    one.loss = loss;
    one.validation_loss = unseen;
    one.bic = -loss;
    return one;
}

TEST(arx_order_plot, the_best_for_each_number_of_parameters) {  // oracle: the candidates themselves
    const ArxSelection selection{{candidate(1, 1, 5, 6), candidate(1, 2, 4, 5), candidate(2, 1, 3, 7)}, 100, true};
    const Figure loss = arx_order_plot(selection, ArxCriterion::kLoss, {1, {}});
    loss.validate();
    const auto& curves = loss.panels.front().curves;
    ASSERT_EQ(curves.size(), 3u);  // both data sets, the chosen one
    EXPECT_EQ(curves[0].x, (Vector{{2, 3}}));
    EXPECT_EQ(curves[0].y, (Vector{{5, 3}}));
    EXPECT_EQ(curves[1].y, (Vector{{6, 5}}));
    EXPECT_EQ(curves[2].x, Vector::Constant(1, 3));
    EXPECT_EQ(curves[2].y, Vector::Constant(1, 5));
    const Figure bic = arx_order_plot(selection, ArxCriterion::kBic, {0, {}});
    ASSERT_EQ(bic.panels.front().curves.size(), 2u);
    EXPECT_EQ(bic.panels.front().curves[0].y, (Vector{{-5, -4}}));
    EXPECT_EQ(message_text(bic.panels.front().y_label), "BIC");
    EXPECT_THROW(arx_order_plot({}, ArxCriterion::kBic, {0, {}}), InvalidArgument);
}

}  // namespace test_arx_order_plot
