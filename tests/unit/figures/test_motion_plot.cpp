// Animated plants. Oracle: their geometry by hand, and the samples that the test wrote.
#include "figures/plots/motion_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "figures/figure_layout.h"
#include "figures/gnuplot_script.h"
#include "numerics/error.h"

namespace test_motion_plot {
using namespace dynlab;
using testing::HasSubstr;

/// 4 cm x 2 cm: a rail, a trolley that is drawn 1 cm from the left at 0.2 m and slides 5 cm a meter, and on it a rod
/// that hangs down from (1, 1.5) over 1 cm at 0 rad.
PlantDrawing crane() {
    PlantDrawing plant;
    plant.width = 4, plant.height = 2;
    plant.parts = {{"position", "m", -1, false, 5, 0, 1, 0.2}, {"angle", "rad", 0, true, 1, 1.5, 1, 0}};
    plant.pieces = {{{0, 4}, {1.5, 1.5}, {-1, -1}, false, 0.5},
                    {{0, 1}, {1.2, 1.2}, {-1, 0}, false, 0.5},
                    {{1, 1}, {1.5, 0.5}, {1, 1}, false, 1.1},
                    {{0.9, 1.1, 1}, {0.5, 0.5, 0.4}, {1, 1, 1}, true, 0.35}};
    return plant;
}

MotionData simulated_data(Index count, double step) {
    MotionData made;
    made.t = Vector::LinSpaced(count, 0, step * static_cast<double>(count - 1));
    made.measured.resize(count, 2);
    made.measured.col(0) = 0.1 * made.t, made.measured.col(1) = 0.3 * made.t.array().sin();
    made.simulated = made.measured.array() + 0.01;
    return made;
}

MotionAppearance at(const Vector& instants) {
    MotionAppearance look;
    look.instants = instants;
    return look;
}

TEST(motion_plot, parts_slide_turn_and_are_carried) {
    const PlantDrawing plant = crane();
    const PlantShape rest = plant.placed(plant.pieces[2], Vector{{0.2, 0}});
    EXPECT_EQ(rest.x, plant.pieces[2].x);
    EXPECT_EQ(rest.y, plant.pieces[2].y);
    // 0.1 m to the right is 0.5 cm; a quarter turn to the left brings the rod's end from below to the right
    const PlantShape moved = plant.placed(plant.pieces[2], Vector{{0.3, std::numbers::pi / 2}});
    EXPECT_NEAR(moved.x[0], 1.5, 1e-12);
    EXPECT_NEAR(moved.y[0], 1.5, 1e-12);
    EXPECT_NEAR(moved.x[1], 2.5, 1e-12);
    EXPECT_NEAR(moved.y[1], 1.5, 1e-12);
    const PlantShape rope = plant.placed(plant.pieces[1], Vector{{0, 1}});  // one end stays
    EXPECT_NEAR(rope.x[0], 0, 1e-15);
    EXPECT_NEAR(rope.x[1], 0, 1e-15);
    EXPECT_TRUE(plant.pieces[1].moves());
    EXPECT_FALSE(plant.pieces[0].moves());
}

TEST(motion_plot, shows_pictures_where_their_instants_lie) {
    const MotionData all = simulated_data(401, 0.05);
    const Figure figure = motion_plot(crane(), all, at(Vector{{15.0, 5.0}}));
    ASSERT_EQ(figure.panels.size(), 3u);
    const Panel& pictures = figure.panels[0];
    ASSERT_EQ(pictures.curves.size(), 3u);  // the fixed parts, measured, simulated
    const Rectangle frame = lay_out(figure).panels[0].box;
    const double seconds_per_cm = 20 / frame.width();
    // Of the four points of the rope and the rod in the first picture, at 5 s: the trolley stood at 0.5 m.
    const Curve& measured = pictures.curves[1];
    const double scale = (measured.x[4] - measured.x[3]) / seconds_per_cm / std::sin(all.measured(100, 1));
    const double rope_end = 5 + (1 + 5 * (0.5 - 0.2) - 2) * scale * seconds_per_cm;
    EXPECT_NEAR(measured.x[1], rope_end, 1e-9);
    EXPECT_NEAR(measured.x[3], rope_end, 1e-9);
    EXPECT_NEAR(measured.y[3] - measured.y[4], scale * std::cos(all.measured(100, 1)), 1e-9);
    EXPECT_LE(2.6 * scale, frame.height() + 1e-9);  // not distorted, and within the frame
    for (const Curve& curve : pictures.curves)
        for (const double y : curve.y)
            EXPECT_TRUE(std::isnan(y) || (y >= pictures.y_range->first && y <= pictures.y_range->second));
    EXPECT_EQ(figure.panels[1].references.size(), 2u);
    EXPECT_EQ(figure.panels[1].curves[0].y, all.measured.col(0));
    EXPECT_EQ(figure.panels[2].curves[1].y, all.simulated.col(1));
    EXPECT_EQ(message_text(figure.panels[2].y_label), "angle (rad)");
    EXPECT_TRUE(lay_out(figure).panels[0].y.ticks.empty());
    const std::string script = gnuplot_script(figure, FigureFormat::kPdf);
    EXPECT_LT(script.find("unset ytics"), script.find("set ytics")) << "gnuplot chooses none of its own";
    // in the middle of the frame: as much above the rail's rim as below the rod's
    const double middle = 0.5 * (pictures.y_range->first + pictures.y_range->second);
    EXPECT_NEAR(pictures.curves[0].y[0] - middle, scale * (1.5 - 0.5 * 2), 1e-9);
}

TEST(motion_plot, keeps_fifty_samples_a_second) {
    const Figure fine = motion_plot(crane(), simulated_data(1001, 0.002));
    EXPECT_EQ(fine.panels[1].curves[0].x.size(), 101);  // 2 s
    EXPECT_NEAR(fine.panels[1].curves[0].x[7], 0.14, 1e-12);
    EXPECT_EQ(motion_plot(crane(), simulated_data(101, 0.02)).panels[1].curves[0].x.size(), 101);
    EXPECT_EQ(motion_plot(crane(), simulated_data(101, 0.02)).panels[1].references.size(), 4u);
}

TEST(motion_plot, goes_to_the_end_of_its_record_however_short) {
    const Figure figure = motion_plot(crane(), simulated_data(3, 0.005));
    EXPECT_EQ(figure.panels[1].curves[0].x, (Vector{{0.0, 0.01}}));
    const Vector late{{9.99}};
    EXPECT_NEAR(motion_plot(crane(), simulated_data(2000, 0.005), at(late)).panels[1].curves[0].x.tail(1)[0], 9.995,
                1e-12);
}

TEST(motion_plot, one_side_alone_will_do) {
    MotionData alone = simulated_data(101, 0.1);
    alone.measured.resize(0, 0);
    const Figure figure = motion_plot(crane(), alone);
    EXPECT_EQ(figure.panels[0].curves.size(), 2u);
    EXPECT_EQ(figure.panels[1].curves.size(), 1u);
    EXPECT_FALSE(figure.motion->measured);
    EXPECT_TRUE(figure.motion->simulated);
}

std::string refusal(const PlantDrawing& plant, const MotionData& made, const MotionAppearance& look = {}) {
    try {
        motion_plot(plant, made, look);
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "";
}

TEST(motion_plot, says_what_does_not_fit) {
    MotionData falling = simulated_data(10, 0.1);
    falling.t[4] = falling.t[3];
    EXPECT_THAT(refusal(crane(), falling), HasSubstr("must increase, but instant 4 is 0.3"));
    MotionData none = simulated_data(10, 0.1);
    none.measured.resize(0, 0), none.simulated.resize(0, 0);
    EXPECT_THAT(refusal(crane(), none), HasSubstr("measured or simulated"));
    MotionData narrow = simulated_data(10, 0.1);
    narrow.measured = narrow.measured.leftCols(1).eval();
    EXPECT_THAT(refusal(crane(), narrow), HasSubstr("10 x 2, but they are 10 x 1"));
    EXPECT_THAT(refusal(crane(), simulated_data(10, 0.1), at(Vector{{2.0}})), HasSubstr("range from 0 s to 0.9"));
    EXPECT_THAT(refusal(crane(), simulated_data(10, 0.1), at(Vector{{0.5, 0.2, 0.5}})),
                HasSubstr("0.5 s occurs twice in the list"));
    PlantDrawing wrong = crane();
    wrong.parts[1].on = 1;
    EXPECT_THAT(refusal(wrong, simulated_data(10, 0.1)), HasSubstr("defined before that part"));
    wrong = crane();
    wrong.pieces[0].part[1] = 2;
    EXPECT_THAT(refusal(wrong, simulated_data(10, 0.1)), HasSubstr("a part that does not exist"));
    Figure cut = motion_plot(crane(), simulated_data(10, 0.1));
    cut.panels[2].curves.pop_back();
    EXPECT_THROW(cut.validate(), InvalidArgument);
}

}  // namespace test_motion_plot
