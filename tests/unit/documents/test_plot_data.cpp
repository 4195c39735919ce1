// The data from which pages draw figures. Oracles: the samples given; per column of the frame, the extremes of all
// samples; the places that gnuplot gets for the printed figure.
#include "documents/html/plot_data.h"
#include "figures/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

#include "base/languages.h"
#include "data_io/values/cbor_values.h"
#include "documents/figure_description.h"
#include "figures/gnuplot_script.h"
#include "numerics/error.h"

namespace test_plot_data {

using namespace dynlab;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

Figure figure_of(const Vector& x, const Vector& y) {
    Panel panel;
    panel.x_label = Message("time (s)");
    panel.y_label = Message("output y");
    Curve curve;
    curve.x = x, curve.y = y, curve.label = Message("measured");
    panel.curves.push_back(curve);
    return Figure(panel);
}

json written(const Figure& figure, const Reader& reader = {}) {
    return json::parse(plot_data(figure, reader));
}

json first_curve(const Figure& figure) {
    return written(figure)["panels"][0]["curves"][0];
}

TEST(plot_data, holds_the_samples_to_1e_5_of_the_axis) {
    const Index count = 300;
    const Vector x = Vector::LinSpaced(count, 2, 7).array().square();
    const Vector y = 1000 + x.array().sin() * 1e-3;
    const json curve = first_curve(figure_of(x, y));
    ASSERT_EQ(curve["y"].size(), static_cast<std::size_t>(count));
    for (Index i = 0; i < count; ++i) {
        EXPECT_NEAR(curve["x"][static_cast<std::size_t>(i)], x[i], 45e-5);
        EXPECT_NEAR(curve["y"][static_cast<std::size_t>(i)], y[i], 2e-8);
    }
}

TEST(plot_data, describes_equally_spaced_samples_by_three_numbers) {
    const json x = first_curve(figure_of(Vector::LinSpaced(101, 3, 4), Vector::Random(101)))["x"];
    EXPECT_EQ(x["from"], 3.0);
    EXPECT_NEAR(x["step"], 0.01, 1e-15);
    EXPECT_EQ(x["count"], 101);
}

TEST(plot_data, curves_over_the_same_abscissas_name_the_first) {
    Figure figure = figure_of(Vector::LinSpaced(9, 0, 1), Vector::Random(9));
    figure.panels[0].curves.push_back(figure.panels[0].curves[0]);
    figure.panels[0].curves.push_back(figure.panels[0].curves[0]);
    const json curves = written(figure)["panels"][0]["curves"];
    EXPECT_EQ(curves[1]["x"], 0);
    EXPECT_EQ(curves[2]["x"], 0);
}

TEST(plot_data, long_records_keep_the_extremes_of_every_column) {
    const Index count = 1'000'000;
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    Vector y(count);
    for (double& value : y) value = normal(generator);
    const Vector x = Vector::LinSpaced(count, 0, 50);
    const std::string text = plot_data(figure_of(x, y));
    EXPECT_LT(text.size(), 100'000u);
    const json panel = json::parse(text)["panels"][0], curve = panel["curves"][0];
    ASSERT_LE(curve["y"].size(), 4004u);
    EXPECT_EQ(curve.value("samples", Index{0}), count);
    EXPECT_FALSE(first_curve(figure_of(Vector::LinSpaced(4000, 0, 1), Vector::Random(4000))).contains("samples"));
    std::map<long, std::pair<double, double>> all, kept;
    const auto include = [](auto& extremes, double at, double value) {
        auto [place, fresh] = extremes.try_emplace(std::lround(std::floor(at / 50 * 1000)), value, value);
        place->second = {std::min(place->second.first, value), std::max(place->second.second, value)};
    };
    for (Index i = 0; i < count; ++i) include(all, x[i], y[i]);
    for (std::size_t i = 0; i < curve["y"].size(); ++i) include(kept, curve["x"][i], curve["y"][i]);
    int other = 0;  // a sample at a column's edge may be rounded into its neighbor
    for (const auto& [column, extremes] : all)
        other += std::abs(kept[column].first - extremes.first) > 1e-4 ||
                 std::abs(kept[column].second - extremes.second) > 1e-4;
    EXPECT_LE(other, 10);
}

TEST(plot_data, gaps_are_null_and_bands_have_both_edges) {
    Vector y = Vector::LinSpaced(5, 1, 5);
    y[2] = std::numeric_limits<double>::quiet_NaN();
    Figure figure = figure_of(Vector::LinSpaced(5, 0, 4), y);
    figure.panels[0].curves[0].style = CurveStyle::kBand;
    figure.panels[0].curves[0].y_upper = y.array() + 1;
    const json curve = first_curve(figure);
    EXPECT_EQ(curve["style"], "band");
    EXPECT_TRUE(curve["y"][2].is_null());
    EXPECT_EQ(curve["upper"][3], 5.0);
}

TEST(plot_data, frames_and_numbers_stand_where_gnuplot_puts_them) {
    Figure figure = figure_of(Vector::LinSpaced(50, 0.1, 40), Vector::LinSpaced(50, 1, 3e6));
    figure.panels.push_back(figure.panels[0]);
    figure.panels[1].log_x = figure.panels[1].log_y = true;
    figure.rows = 2;
    const std::string script = gnuplot_script(figure, FigureFormat::kSvg);
    const json plot = written(figure);
    const std::regex margins(
        R"(set lmargin at screen ([\d.]+); set rmargin at screen ([\d.]+)\nset bmargin at screen ([\d.]+); set tmargin at screen ([\d.]+))");
    auto found = std::sregex_iterator(script.begin(), script.end(), margins);
    for (const json& panel : plot["panels"]) {
        ASSERT_NE(found, std::sregex_iterator());
        for (const std::size_t side : {0, 1, 2, 3}) {
            const std::size_t number = std::array{1, 3, 2, 4}[side];
            const double length = plot["size"][side % 2];
            EXPECT_NEAR(panel["box"][side].get<double>() / length, std::stod((*found)[number]), 1e-6) << side;
        }
        ++found;
    }
    EXPECT_EQ(plot["panels"][0]["y"]["exponent"], 6);
    for (const json& tick : plot["panels"][0]["y"]["ticks"])
        EXPECT_THAT(script, HasSubstr("set label '" + tick[1].get<std::string>() + "' at"));
    EXPECT_EQ(plot["panels"][1]["x"]["log"], true);
}

TEST(plot_data, texts_cannot_end_the_element_they_stand_in) {
    Figure figure = figure_of(Vector::LinSpaced(5, 0, 4), Vector::Random(5));
    figure.panels[0].curves[0].label = Message("</script><script>alert(1)</script> \\\" ü");
    const std::string text = plot_data(figure);
    EXPECT_THAT(text, Not(HasSubstr("<")));
    EXPECT_EQ(json::parse(text)["panels"][0]["curves"][0]["name"], "</script><script>alert(1)</script> \\\" ü");
}

TEST(plot_data, french_numbers_have_a_comma_and_powers_are_raised) {
    Figure figure = figure_of(Vector::LinSpaced(5, 0, 1), Vector::Random(5));
    figure.panels[0].x_label = Message("x_{max} in m^{2}");
    const json panel = written(figure, {catalog_of("fr")})["panels"][0];
    EXPECT_THAT(panel["x"]["ticks"].dump(), HasSubstr("\"0,"));
    EXPECT_EQ(panel["x"]["label"], json({"=x", "_max", "= in m", "^2"}));
}

TEST(plot_data, of_a_stored_figure_is_in_the_language_of_a_later_reader) {
    Figure figure = figure_of(Vector::LinSpaced(5, 0, 1), Vector::LinSpaced(5, 0, 1));
    figure.panels[0].x_label = axis_label(Message("time"), "s");
    figure.panels[0].curves[0].label = Message("{}: {} %", Message::verbatim("G"), decimals(93.2, 1));
    const Figure again = from_cbor<Figure>(cbor_of(figure));
    EXPECT_EQ(again.panels[0].curves[0].label, figure.panels[0].curves[0].label);
    const json panel = written(again, {catalog_of("fr")})["panels"][0];
    EXPECT_EQ(panel["x"]["label"], "temps (s)");
    EXPECT_EQ(panel["curves"][0]["name"], "G : 93,2 %");
}

TEST(plot_data, refuses_what_cannot_be_drawn) {
    EXPECT_THROW(plot_data(figure_of(Vector::Zero(3), Vector::Zero(2))), InvalidArgument);
}

}  // namespace test_plot_data
