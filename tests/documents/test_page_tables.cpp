// The data of a page's figures as tables, in a real browser. Oracle: the samples that the test wrote.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/languages.h"
#include "document_fixture.h"
#include "documents/html/plot_data.h"
#include "figures/figure.h"
#include "support/browser.h"

namespace dynlab {
namespace test_page_tables {

using nlohmann::json;
using test::Browser;

class page_tables : public DocumentTest {
  protected:
    void open(const Figure& figure, const std::string& language = "en") {
        add_figure("shown", "A figure", DocumentFormat::kHtml);
        record_.figures["shown"].plot = plot_data(figure, {catalog_of(language)});
        make("---\nlang: " + language + "\n---\n\n![](figure:shown)\n", "page.html");
        browser.open("file://" + file("page.html").string());
        ASSERT_TRUE(browser.becomes_true("document.querySelector('.plot .data') !== null"));
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    json rows(int table = 0) {
        return value(
            fmt::format("[...document.querySelectorAll('.samples')[{}].querySelectorAll('tr')].map(row => "
                        "[...row.cells].map(cell => cell.innerText))",
                        table));
    }
    void press(const std::string& key) {
        const json actions = {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}};
        browser.act(json::array({{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}).dump());
    }
    Browser browser;
};

Curve curve_of(const Vector& x, const Vector& y, const std::string& label) {
    Curve curve;
    curve.x = x, curve.y = y, curve.label = Message::verbatim(label);
    return curve;
}

Figure two_panels(Index count) {
    const Vector t = Vector::LinSpaced(count, 0, 0.5 * static_cast<double>(count - 1));
    Panel above, below;
    above.y_label = Message("position (m)"), below.y_label = Message("angle (rad)"),
    below.x_label = Message("time (s)");
    above.curves = {curve_of(t, 2 * t, "measured"), curve_of(t, -t, "simulated, \"free\"")};
    below.curves = {curve_of(t, 0.25 * t.array() + 0.125, "")};
    Figure figure;
    figure.rows = 2;
    figure.panels = {above, below};
    return figure;
}

TEST_F(page_tables, hold_all_curves_over_one_time_with_headings_and_units) {
    open(two_panels(4));
    EXPECT_EQ(value("document.querySelectorAll('.samples').length"), 0) << "closed at first";
    browser.evaluate("document.querySelector('.plot .data').click()");
    const json expected = {{"time (s)", "measured: position (m)", "simulated, \"free\": position (m)", "angle (rad)"},
                           {"0", "0", "0", "0.125"},
                           {"0.5", "1", "−0.5", "0.25"},
                           {"1", "2", "−1", "0.375"},
                           {"1.5", "3", "−1.5", "0.5"}};
    EXPECT_EQ(rows(), expected);
    EXPECT_EQ(value("document.querySelectorAll('.samples th[scope=col]').length"), 4);
    EXPECT_EQ(value("document.querySelectorAll('.samples th[scope=row]').length"), 4);
    EXPECT_EQ(value("document.querySelector('.samples caption').innerText"), "4 samples");
    EXPECT_EQ(value("document.querySelector('.plot .data').getAttribute('aria-expanded')"), "true");
    browser.evaluate("document.querySelector('.plot .data').click()");
    EXPECT_EQ(value("document.querySelectorAll('.samples').length"), 0);
}

TEST_F(page_tables, are_copied_whole_and_shown_thinned) {
    open(two_panels(1001));
    browser.evaluate("document.querySelector('.plot .data').click()");
    const json shown = rows();
    EXPECT_LE(shown.size(), 201u);
    EXPECT_GE(shown.size(), 100u);
    EXPECT_EQ(shown.back()[0], "500") << "the last sample is among them";
    EXPECT_EQ(value("document.querySelector('.samples caption').innerText"),
              fmt::format("{} of 1001 samples", shown.size() - 1));
    browser.evaluate(
        "Object.defineProperty(navigator, 'clipboard', {value: {writeText: text => { window.copied = text; }}});"
        "document.querySelector('.samples .csv').click()");
    ASSERT_TRUE(browser.becomes_true("window.copied !== undefined"));
    const std::string csv = value("copied");
    EXPECT_TRUE(
        csv.starts_with("time (s),measured: position (m),\"simulated, \"\"free\"\": position (m)\",angle (rad)\n"
                        "0,0,0,0.125\n0.5,1,-0.5,0.25\n"))
        << csv.substr(0, 200);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1002);
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.samples .csv').innerText === 'Copied'"));
}

/// Oracle: as many rows as the curve on the page has points.
TEST_F(page_tables, of_very_long_records_say_that_they_are_thinned) {
    Figure figure = two_panels(20001);
    figure.panels[0].curves[0].y = figure.panels[0].curves[0].x.array().sin();
    figure.panels[0].curves.resize(1);
    figure.panels[0].curves.push_back(curve_of(Vector{{0.0, 10000.0}}, Vector{{1.0, 1.0}}, "level"));
    open(figure);
    browser.evaluate("document.querySelector('.plot .data').click()");
    const int kept = value("document.querySelector('.plot').plot.panels[0].curves[0].x.length");
    ASSERT_LT(kept, 4100);
    const int seen = static_cast<int>(rows().size()) - 1;
    EXPECT_EQ(value("document.querySelectorAll('.samples caption')[0].innerText"),
              fmt::format("reduced to {} of 20001 samples, {} of them shown", kept, seen));
    EXPECT_EQ(value("document.querySelectorAll('.samples caption')[1].innerText"), "2 samples");
    browser.evaluate(
        "Object.defineProperty(navigator, 'clipboard', {value: {writeText: text => { window.copied = text; }}});"
        "document.querySelector('.samples .csv').click()");
    ASSERT_TRUE(browser.becomes_true("window.copied !== undefined"));
    const std::string csv = value("copied");
    EXPECT_TRUE(csv.starts_with(fmt::format("# reduced to {} of 20001 samples\ntime (s),", kept)))
        << csv.substr(0, 200);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), kept + 2);
}

TEST_F(page_tables, distinguish_curves_of_other_abscissas_and_both_edges_of_bands) {
    Panel panel;
    panel.x_label = Message("x"), panel.y_label = Message("y (V)");
    Curve band = curve_of(Vector{{0.0, 1.0}}, Vector{{1.0, 2.0}}, "band");
    band.style = CurveStyle::kBand, band.y_upper = Vector{{3.0, 4.5}};
    panel.curves = {band, curve_of(Vector{{0.0, 0.25}}, Vector{{1.0, std::nan("")}}, "gap")};
    open(Figure(panel), "fr");
    browser.evaluate("document.querySelector('.plot .data').click()");
    EXPECT_EQ(rows(0), (json{{"x", "band: y (V), bas", "band: y (V), haut"}, {"0", "1", "3"}, {"1", "2", "4,5"}}));
    EXPECT_EQ(rows(1), json::parse(R"j([["x", "gap: y (V)"], ["0", "1"], ["0,25", ""]])j"));
    EXPECT_EQ(value("document.querySelector('.plot .data').innerText"), "Données");
}

TEST_F(page_tables, are_reached_by_keyboard_and_not_printed) {
    open(two_panels(4));
    browser.evaluate("document.querySelector('.plot').focus()");
    for (int i = 0; i < 10 && value("document.activeElement.className") != "data"; ++i) press("\uE004");
    ASSERT_EQ(value("document.activeElement.className"), "data");
    EXPECT_EQ(value("getComputedStyle(document.activeElement).opacity"), "1") << "seen when it has the focus";
    press(" ");
    EXPECT_EQ(rows().size(), 5u);
    EXPECT_EQ(value("document.querySelector('.samples .rows').tabIndex"), 0) << "can be scrolled by keys";
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": "print"})");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.plot-data-tables')).display"), "none");
}

}  // namespace test_page_tables
}  // namespace dynlab
