// Names beside their curves. Oracle: the geometry of lines.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "figures/label_placement.h"
#include "figures/style.h"

namespace test_label_placement {

using namespace dynlab;

Curve line(const std::string& name, double from, double to) {
    Curve curve;
    curve.x = Vector::LinSpaced(101, 0, 10);
    curve.y = Vector::LinSpaced(101, from, to);
    curve.label = Message::verbatim(name);
    return curve;
}

Figure with_names(std::vector<Curve> curves) {
    Panel panel;
    panel.curves = std::move(curves);
    panel.y_range = {0, 4};
    panel.legend = LegendPlace::kDirect;
    return Figure(panel);
}

std::vector<PlacedLabel> labels_of(const Figure& figure, const PanelLayout& layout) {
    std::vector<CurveTraces> traces;
    for (const Curve& curve : figure.panels.front().curves) traces.push_back(traces_of(curve, layout));
    return place_labels(figure.panels.front(), layout, traces);
}

TEST(label_placement, names_stand_beside_their_curves_and_cover_none) {
    const std::vector<std::pair<double, double>> ends = {{1, 1}, {2, 3.5}, {3, 1.6}};
    const std::vector<std::string> names = {"level", "rising", "falling"};
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < ends.size(); ++i) curves.push_back(line(names[i], ends[i].first, ends[i].second));
    const Figure figure = with_names(curves);
    const PanelLayout layout = lay_out(figure).panels.front();
    EXPECT_TRUE(layout.legend.empty());
    const std::vector<PlacedLabel> labels = labels_of(figure, layout);
    ASSERT_EQ(labels.size(), 3u);
    const double width = layout.box.width(), height = layout.box.height();
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(labels[k].text, names[k]);
        const double half = 0.5 * text_width(labels[k].text, style::kTextSize);
        // height of the middle of the text above each line, at its left end, middle and right end
        double own = 1e9, others = 1e9;
        for (std::size_t i = 0; i < 3; ++i)
            for (const double x : {labels[k].x - half, labels[k].x, labels[k].x + half}) {
                EXPECT_GE(x, 0);
                EXPECT_LE(x, width);
                const double y = ends[i].first + (ends[i].second - ends[i].first) * x / width * (layout.x.high / 10);
                const double apart = std::abs(labels[k].y - layout.y.position(y) * height);
                EXPECT_GT(apart, 0.12) << names[k] << " covers " << names[i];
                double& least = i == k ? own : others;
                least = std::min(least, apart);
            }
        EXPECT_LT(own, 0.6) << names[k];
        EXPECT_LT(own, others) << names[k];
    }
}

TEST(label_placement, curves_that_lie_together_have_a_legend) {
    const Figure figure = with_names({line("measured", 1, 2), line("simulated", 1.01, 2.01)});
    const PanelLayout layout = lay_out(figure).panels.front();
    EXPECT_EQ(layout.legend.size(), 2u);
    EXPECT_TRUE(labels_of(figure, layout).empty());
}

// Oracle: a place on a page is a number within a page's size; the sanitizer sees one that is none.
TEST(label_placement, texts_of_marks_at_the_ends_of_all_numbers_have_finite_places) {
    const double huge = std::numeric_limits<double>::max();
    for (const double x : {0.0, huge, -huge})
        for (const double y : {0.0, huge, -huge}) {
            Figure figure = with_names({line("measured", 1, 2)});
            Panel& panel = figure.panels.front();
            panel.annotations.push_back({x, y, Message::verbatim("far")});
            panel.arrows.push_back({-huge, -y, x, y, Message::verbatim("between")});
            panel.references.push_back({true, y, Message::verbatim("level"), 1});
            for (const PlacedLabel& label : labels_of(figure, lay_out(figure).panels.front())) {
                EXPECT_TRUE(std::isfinite(label.x) && std::isfinite(label.y)) << label.text << " " << x << " " << y;
            }
        }
}

TEST(label_placement, bands_are_named_in_a_legend) {
    Figure figure = with_names({line("curve", 1, 2), line("band", 2.8, 3.5)});
    Curve& band = figure.panels.front().curves.back();
    band.style = CurveStyle::kBand;
    band.y_upper = band.y.array() + 0.3;
    EXPECT_EQ(lay_out(figure).panels.front().legend.size(), 2u);
}

TEST(label_placement, names_stand_beside_curves_only_where_asked_for) {
    Figure figure = with_names({line("low", 1, 1), line("high", 3, 3)});
    figure.panels.front().legend = LegendPlace::kAutomatic;
    const PanelLayout layout = lay_out(figure).panels.front();
    EXPECT_EQ(layout.legend.size(), 2u);
    EXPECT_TRUE(labels_of(figure, layout).empty());
}

}  // namespace test_label_placement
