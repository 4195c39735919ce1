#include "figures/french_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "figures/figure.h"
#include "figures/gnuplot_script.h"

namespace dynlab::test {
namespace test_french_texts {
using testing::HasSubstr;
using testing::Not;

Figure picture(const std::string& x_label, const std::string& curve) {
    Panel panel;
    panel.x_label = x_label;
    panel.y_label = "angle (rad)";
    panel.x_range = {0, 1};
    Curve line;
    line.x = Vector{{0, 0.5, 1}};
    line.y = Vector{{0, 0.25, 0.5}};
    line.label = curve;
    panel.curves.push_back(line);
    panel.references.emplace_back();
    panel.references.back().at = 0.5;
    panel.references.back().label = "best";
    return Figure(panel);
}

TEST(french_texts, decimal_points_become_commas_and_other_points_stay) {
    EXPECT_EQ(with_decimal_commas("G: 93.2 % of 0.5"), "G: 93,2 % of 0,5");
    for (const char* text : {"", ".", "1.", ".5", "1.2.3", "end. 5", "a.1", "20", "modèle 3.", "12.."})
        EXPECT_EQ(with_decimal_commas(text), text);
}

TEST(french_texts, what_the_standard_plots_write_is_french_with_any_unit) {
    const Figure french = in_french(picture("time (min)", "measured"));
    EXPECT_EQ(french.panels[0].x_label, "temps (min)");
    EXPECT_EQ(french.panels[0].curves[0].label, "mesuré");
    EXPECT_EQ(in_french(picture("lag (samples)", "experiment 2")).panels[0].x_label, "décalage (échantillons)");
    EXPECT_EQ(in_french(picture("lag (samples)", "experiment 2")).panels[0].curves[0].label, "expérience 2");
}

TEST(french_texts, what_somebody_wrote_stays) {
    const Figure french = in_french(picture("time of day (h)", "my measured speed"));
    EXPECT_EQ(french.panels[0].x_label, "time of day (h)");
    EXPECT_EQ(french.panels[0].curves[0].label, "my measured speed");
    EXPECT_EQ(french.panels[0].y_label, "angle (rad)");
    EXPECT_EQ(french.panels[0].references[0].label, "best");
}

TEST(french_texts, numbers_beside_the_axes_have_commas_where_asked_for) {
    const Figure figure = picture("x", "y");
    const std::string plain = gnuplot_script(figure, FigureFormat::kSvg);
    const std::string commas = gnuplot_script(figure, FigureFormat::kSvg, true);
    EXPECT_THAT(plain, HasSubstr("'0.5'"));
    EXPECT_THAT(plain, Not(HasSubstr("'0,5'")));
    EXPECT_THAT(commas, HasSubstr("'0,5'"));
    EXPECT_THAT(commas, Not(HasSubstr("'0.5'")));
}

TEST(french_texts, percentages_stand_behind_what_they_are_of) {
    EXPECT_EQ(in_french(picture("time (s)", "99.5 % confidence")).panels[0].curves[0].label, "confiance à 99,5 %");
    EXPECT_EQ(in_french(picture("time (s)", "99 % bound")).panels[0].curves[0].label, "borne à 99 %");
    EXPECT_EQ(in_french(picture("time (s)", "95 % prediction band")).panels[0].curves[0].label,
              "bande de prévision à 95 %");
    EXPECT_EQ(in_french(picture("time (s)", "my own % bound")).panels[0].curves[0].label, "my own % bound");
}

}  // namespace test_french_texts

}  // namespace dynlab::test
