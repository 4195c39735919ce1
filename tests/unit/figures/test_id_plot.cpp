// Oracle: the legend that the header promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/plots/id_plot.h"
#include "numerics/error.h"

namespace test_id_plot {

using namespace dynlab;
using testing::ElementsAre;

const IdData kData(Matrix(Vector{{0.0, 1.0, 2.0}}), Matrix(Vector{{1.0, 1.0, 0.0}}), 0.1);

std::vector<std::string> legend_of(const Figure& figure) {
    std::vector<std::string> labels;
    for (const Curve& curve : figure.panels.front().curves) labels.push_back(message_text(curve.label));
    return labels;
}

TEST(id_plot, one_object_is_named_only_when_asked) {
    EXPECT_THAT(legend_of(id_plot({&kData})), ElementsAre(""));
    EXPECT_THAT(legend_of(id_plot({&kData}, {"measured"})), ElementsAre("measured"));
}

TEST(id_plot, several_objects_are_distinguished) {
    EXPECT_THAT(legend_of(id_plot({&kData, &kData})), ElementsAre("data 1", "data 2"));
    EXPECT_THAT(legend_of(id_plot({&kData, &kData}, {"raw", "clean"})), ElementsAre("raw", "clean"));
    EXPECT_THROW(id_plot({&kData, &kData}, {"raw"}), InvalidArgument);
}

TEST(id_plot, an_input_that_several_share_is_drawn_once) {
    IdData other = kData;
    other.experiments[0].y *= 2;
    const Figure shared = id_plot({&kData, &other});
    EXPECT_EQ(shared.panels[0].curves.size(), 2u);
    ASSERT_EQ(shared.panels[1].curves.size(), 1u);
    EXPECT_NE(shared.panels[1].curves[0].color, shared.panels[0].curves[0].color);  // it is not the first one's alone
    other.experiments[0].u(1) = 0.5;
    EXPECT_EQ(id_plot({&kData, &other}).panels[1].curves.size(), 2u);
}

TEST(id_plot, held_inputs_are_stairs_below_the_outputs) {
    const Figure figure = id_plot({&kData});
    ASSERT_EQ(figure.panels.size(), 2u);
    EXPECT_EQ(figure.panels[0].curves[0].style, CurveStyle::kLine);
    EXPECT_EQ(figure.panels[1].curves[0].style, CurveStyle::kStairs);
}

}  // namespace test_id_plot
