// Figures of an HTML document in a real browser, from a file. Oracle: the samples the test wrote, at the places where
// the frame says they are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/languages.h"
#include "documents/document.h"
#include "documents/html/plot_data.h"
#include "figures/figure.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"

namespace test_page_figures {
using namespace dynlab;
using nlohmann::json;
using test::Browser;
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// y = 2 x V from 0 to 10 s, and 20 V - y dashed.
Figure ramps() {
    Panel panel;
    panel.x_label = Message("time (s)");
    panel.y_label = Message("output (V)");
    Curve up, down;
    up.x = down.x = Vector::LinSpaced(1001, 0, 10);
    up.y = 2 * up.x;
    down.y = 20 - up.y.array();
    up.label = Message("up <b>ramp</b>"), down.label = Message("down");
    panel.curves = {up, down};
    panel.x_range = {0, 10}, panel.y_range = {0, 20};
    return Figure(panel);
}

class page_figures : public testing::Test {
  protected:
    void make(const Figure& figure, const std::string& language = "en") {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        RecordedFigure recorded;
        recorded.caption = "Two ramps";
        recorded.file = folder.path() / "ramps.svg";
        recorded.plot = plot_data(figure, {catalog_of(language)});
        const json size = json::parse(recorded.plot)["size"];
        const auto pixels = [&](int side) { return std::lround(size[side].get<double>() / 2.54 * 96); };
        std::ofstream(recorded.file) << fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\"><path d=\"M0 100 L200 0\" "
            "stroke=\"black\"/></svg>\n",
            pixels(0), pixels(1));
        record.figures["ramps"] = recorded;
        std::ofstream(folder.path() / "report.md")
            << "---\ntitle: Ramps\nlang: " << language << "\n---\n\n![](figure:ramps)\n\n"
            << std::string(60, '\n') << "Words.\n\n";
        DocumentSource source;
        source.template_file = folder.path() / "report.md";
        source.record = &record;
        DocumentMaker({.use_cache = false}).make(source, page(), DocumentFormat::kHtml, nullptr);
    }
    fs::path page() const { return folder.path() / "page.html"; }

    void open(int number_of_figures = 1) {
        browser.open("file://" + page().string());
        ASSERT_TRUE(
            browser.becomes_true(fmt::format("document.querySelectorAll('.plot').length === {}", number_of_figures)));
        browser.evaluate("window.plot = document.querySelector('.plot').plot; window.panel = plot.panels[0]");
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    std::string reading() {
        return value("(read => read.hidden ? '' : read.innerText)(document.querySelector('.reading'))");
    }

    /// Where in the window a place of the first panel is, in parts of its frame from the lower left corner.
    std::pair<int, int> at(double x, double y) {
        const json place = value(fmt::format(
            "(() => {{ const b = plot.box.getBoundingClientRect(); return [b.left + plot.unit * (panel.left + {} * "
            "panel.width), b.top + plot.unit * (plot.size[1] - panel.bottom - {} * panel.height)] }})()",
            x, y));
        return {static_cast<int>(std::lround(place[0].get<double>())),
                static_cast<int>(std::lround(place[1].get<double>()))};
    }
    static json move(std::pair<int, int> to) {
        return {{"type", "pointerMove"}, {"duration", 0}, {"x", to.first}, {"y", to.second}};
    }
    static json down() { return {{"type", "pointerDown"}, {"button", 0}}; }
    static json up() { return {{"type", "pointerUp"}, {"button", 0}}; }
    static json pointer(const std::string& id, const json& actions, const std::string& kind = "mouse") {
        return {{"type", "pointer"}, {"id", id}, {"parameters", {{"pointerType", kind}}}, {"actions", actions}};
    }
    void mouse(const std::vector<json>& actions) { browser.act(json::array({pointer("mouse", actions)}).dump()); }
    void keys(const std::vector<std::string>& pressed) {
        json actions = json::array();
        for (const std::string& key : pressed) {
            actions.push_back({{"type", "keyDown"}, {"value", key}});
            actions.push_back({{"type", "keyUp"}, {"value", key}});
        }
        browser.act(json::array({{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}).dump());
    }
    void turn_wheel(std::pair<int, int> place, int by) {
        const json turn = {{"type", "scroll"},  {"duration", 0}, {"x", place.first},
                           {"y", place.second}, {"deltaX", 0},   {"deltaY", by}};
        browser.act(json::array({{{"type", "wheel"}, {"id", "wheel"}, {"actions", json::array({turn})}}}).dump());
    }
    /// Red, green, blue and cover of the darkest of the nine pixels of the figure around a place of the frame.
    json color(double x, double y) {
        return value(fmt::format(
            "(() => {{ const d = devicePixelRatio, X = plot.unit * (panel.left + {} * panel.width), Y = plot.unit * "
            "(plot.size[1] - panel.bottom - {} * panel.height), seen = "
            "plot.canvas.getContext('2d').getImageData(Math.round(X * d) - 1, Math.round(Y * d) - 1, 3, 3).data; "
            "return "
            "[0, 1, 2, 3, 4, 5, 6, 7, 8].map(i => [...seen.slice(4 * i, 4 * i + 4)]).sort((a, b) => b[3] - a[3] || "
            "a[0] "
            "- b[0])[0] }})()",
            x, y));
    }

    TemporaryFolder folder;
    RunRecord record;
    Browser browser;
};

TEST_F(page_figures, curves_are_drawn_where_their_samples_lie) {
    make(ramps());
    open();
    const json curve = color(0.23, 0.23), paper = color(0.53, 0.12);
    EXPECT_LT(curve[0].get<int>(), 120) << curve;  // the first color of the palette, #0072B2
    EXPECT_GT(curve[2].get<int>(), 120) << curve;
    EXPECT_EQ(paper[3], 0) << paper;
    EXPECT_EQ(value("performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length"), 0);
    EXPECT_EQ(value("document.querySelectorAll('.plot b').length"), 0) << "labels are text";
}

TEST_F(page_figures, paper_and_browsers_without_scripts_show_the_picture) {
    make(ramps());
    open();
    const double height = value("document.querySelector('figure').offsetHeight");
    const std::string shown = "getComputedStyle(document.querySelector('figure img')).display";
    EXPECT_EQ(value(shown), "none");
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": "print"})");
    EXPECT_EQ(value(shown), "inline");
    EXPECT_EQ(value("getComputedStyle(plot.box).display"), "none");
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": ""})");
    browser.devtools("Emulation.setScriptExecutionDisabled", R"({"value": true})");
    browser.open("file://" + page().string());
    EXPECT_EQ(value("document.querySelectorAll('.plot').length"), 0);
    EXPECT_EQ(value(shown), "inline");
    EXPECT_EQ(value("document.querySelector('figure img').naturalWidth"), 529);
    EXPECT_EQ(value("document.querySelector('figure').offsetHeight"), height) << "nothing moves when it comes";
}

TEST_F(page_figures, the_cursor_reads_all_curves_with_their_units) {
    make(ramps());
    open();
    mouse({move(at(0.3, 0.5))});
    EXPECT_THAT(reading(), testing::MatchesRegex("time: [0-9.]+ s\n● up <b>ramp</b>: [0-9.]+ V\n● down: [0-9.]+ V"));
    const json read = value("document.querySelector('.reading').innerText.match(/[0-9.]+/g).map(Number)");
    EXPECT_NEAR(read[0], 3, 0.03);  // a pixel is 0.02 s wide
    EXPECT_NEAR(read[1], 2 * read[0].get<double>(), 0.006);
    EXPECT_NEAR(read[2], 20 - 2 * read[0].get<double>(), 0.006);
    mouse({move({5, 5})});
    EXPECT_EQ(value("document.querySelector('.reading').hidden"), true);
}

TEST_F(page_figures, a_drawn_box_becomes_the_whole_and_a_double_click_undoes_it) {
    make(ramps());
    open();
    mouse({move(at(0.2, 0.3)), down(), move(at(0.5, 0.5)), move(at(0.6, 0.7)), up()});
    EXPECT_NEAR(value("panel.x.low"), 2, 0.05);
    EXPECT_NEAR(value("panel.x.high"), 6, 0.05);
    EXPECT_NEAR(value("panel.y.low"), 6, 0.15);
    EXPECT_NEAR(value("panel.y.high"), 14, 0.15);
    const double x = value("panel.x.position(4)"), y = value("panel.y.position(8)");
    EXPECT_NEAR(x, 0.5, 0.01);
    EXPECT_NEAR(y, 0.25, 0.01);
    EXPECT_LT(color(x, y)[0].get<int>(), 120) << "the curve is drawn again";
    EXPECT_EQ(value("document.querySelector('.whole').hidden"), false);
    const auto middle = at(0.5, 0.5);
    mouse({move(middle), down(), up(), down(), up()});
    EXPECT_EQ(value("[panel.x.low, panel.x.high, panel.y.low, panel.y.high]"), json({0, 10, 0, 20}));
    EXPECT_EQ(value("document.querySelector('.whole').hidden"), true);
}

TEST_F(page_figures, a_flat_box_and_the_numbers_of_an_axis_mean_that_axis) {
    make(ramps());
    open();
    mouse({move(at(0.2, 0.5)), down(), move(at(0.6, 0.505)), up()});
    EXPECT_NEAR(value("panel.x.low"), 2, 0.05);
    EXPECT_EQ(value("[panel.y.low, panel.y.high]"), json({0, 20}));
}

TEST_F(page_figures, the_wheel_scrolls_the_page_until_the_figure_is_chosen) {
    make(ramps());
    open();
    browser.evaluate("document.querySelector('main').style.paddingBottom = '3000px'");
    turn_wheel(at(0.25, 0.5), 60);
    EXPECT_TRUE(browser.becomes_true("scrollY > 0"));
    EXPECT_EQ(value("panel.x.moved"), false);
    browser.evaluate("scrollTo(0, 0)");
    mouse({move(at(0.25, 0.5)), down(), up()});
    const auto place = at(0.25, 0.5);
    turn_wheel(place, -100);
    ASSERT_TRUE(browser.becomes_true("panel.x.moved"));
    EXPECT_EQ(value("scrollY"), 0);
    // What lies under the pointer stays there.
    EXPECT_NEAR(value("panel.x.position(2.5)"), 0.25, 0.01);
    EXPECT_NEAR(value("panel.y.position(10)"), 0.5, 0.01);
    EXPECT_LT(value("panel.x.high - panel.x.low").get<double>(), 9);
}

/// Years are no measurements. Oracle: the samples.
TEST_F(page_figures, whole_abscissas_are_read_without_decimals) {
    Figure figure = ramps();
    for (Curve& curve : figure.panels[0].curves) curve.x = Vector::LinSpaced(1001, 1000, 2000);
    figure.panels[0].x_range = {1000, 2000}, figure.panels[0].x_label = Message("year");
    make(figure);
    open();
    mouse({move(at(0.956, 0.5))});
    EXPECT_THAT(reading(), testing::MatchesRegex("year: 195[0-9]\n.*"));
}

/// Oracles: an XML reader that browsers have, and the samples.
TEST_F(page_figures, what_is_shown_can_be_copied_as_a_drawing_and_as_numbers) {
    make(ramps());
    open();
    browser.click(".entry");  // a hidden curve is not copied
    browser.evaluate(
        "window.drawing = new DOMParser().parseFromString(dynlabCopies.svg(plot), 'image/svg+xml').documentElement");
    EXPECT_EQ(value("drawing.tagName"), "svg") << value("drawing.textContent");
    EXPECT_EQ(value("[...drawing.querySelectorAll('text')].filter(t => /output|time/.test(t.textContent)).length"), 2);
    EXPECT_EQ(value("[...drawing.querySelectorAll('path')].filter(p => p.getAttribute('stroke') === "
                    "plot.panels[0].curves[1].color && p.getAttribute('d').split('L').length > 100).length"),
              1);
    EXPECT_EQ(value("[...drawing.querySelectorAll('path')].filter(p => p.getAttribute('stroke') === "
                    "plot.panels[0].curves[0].color && p.getAttribute('d').split('L').length > 100).length"),
              0);
    const std::string csv = value("dynlabTables.allAsCsv(plot.readable)");
    EXPECT_THAT(csv, HasSubstr("time (s),up <b>ramp</b>: output (V),down: output (V)\n"));
    EXPECT_THAT(csv, HasSubstr("\n5,10,10\n"));
}

/// Two figures over the same time show one place; one over another quantity does not.
TEST_F(page_figures, cursors_of_figures_over_the_same_quantity_are_linked) {
    make(ramps());
    open();
    browser.evaluate(
        "const other = JSON.parse(document.querySelector('script.plot-data').textContent); const holder = "
        "document.createElement('div'); document.body.append(holder); window.same = dynlabPlots.show(holder, other, "
        "'same'); const third = JSON.parse(JSON.stringify(other)); third.panels[0].x.label = 'frequency (Hz)'; "
        "window.another = dynlabPlots.show(holder, third, 'another')");
    ASSERT_TRUE(browser.becomes_true("same.unit > 0 && another.unit > 0"));
    const auto drawn = [&](const std::string& plot) {
        return value(
            "(p => p.over.getContext('2d').getImageData(0, 0, p.over.width, p.over.height).data.some(x => x > "
            "0))(" +
            plot + ")");
    };
    EXPECT_EQ(drawn("same"), false);
    mouse({move(at(0.3, 0.5))});
    EXPECT_EQ(drawn("same"), true);
    EXPECT_EQ(drawn("another"), false);
    EXPECT_NEAR(value("same.linked.value"), 3, 0.03);
    mouse({move({5, 5})});
    EXPECT_EQ(drawn("same"), false);
}

TEST_F(page_figures, the_keyboard_alone_reads_zooms_moves_and_resets) {
    make(ramps());
    open();
    browser.evaluate("plot.box.focus()");
    const std::string right = "\uE014", left = "\uE012", shift = "\uE008", escape = "\uE00C";
    keys({right});
    EXPECT_THAT(reading(), HasSubstr("time: 5.0"));
    keys({right, right});
    EXPECT_THAT(reading(), Not(HasSubstr("time: 5.00")));
    EXPECT_EQ(value("document.querySelector('.reading').getAttribute('aria-live')"), "polite");
    keys({"+"});
    EXPECT_NEAR(value("panel.x.high - panel.x.low"), 7, 0.01);
    const double low = value("panel.x.low");
    browser.act(json::array({{{"type", "key"},
                              {"id", "keys"},
                              {"actions",
                               {{{"type", "keyDown"}, {"value", shift}},
                                {{"type", "keyDown"}, {"value", left}},
                                {{"type", "keyUp"}, {"value", left}},
                                {{"type", "keyUp"}, {"value", shift}}}}}})
                    .dump());
    EXPECT_NEAR(value("panel.x.low").get<double>(), low - 0.7, 0.01);
    keys({"-", "0"});
    EXPECT_EQ(value("[panel.x.low, panel.x.high]"), json({0, 10}));
    keys({escape});
    EXPECT_EQ(value("document.querySelector('.reading').hidden"), true);
}

TEST_F(page_figures, two_fingers_zoom_and_one_reads) {
    make(ramps());
    open();
    const json hold = {{"type", "pause"}, {"duration", 0}};
    const json first = {move(at(0.4, 0.5)), down(), hold, hold, hold, up()};
    const json second = {move(at(0.6, 0.5)), hold, down(), move(at(0.7, 0.5)), move(at(0.8, 0.5)), up()};
    browser.act(json::array({pointer("one", first, "touch"), pointer("two", second, "touch")}).dump());
    EXPECT_NEAR(value("panel.x.high - panel.x.low"), 5, 0.2);  // twice as far apart
    EXPECT_NEAR(value("panel.x.position(4)"), 0.4, 0.02);
    browser.act(json::array({pointer("one", {move(at(0.5, 0.5)), down(), up()}, "touch")}).dump());
    EXPECT_THAT(reading(), HasSubstr("time: 4.5"));
}

TEST_F(page_figures, an_entry_of_the_legend_hides_its_curve) {
    make(ramps());
    open();
    EXPECT_EQ(value("document.querySelectorAll('.entry').length"), 2);
    browser.click(".entry");
    EXPECT_EQ(value("document.querySelector('.entry').getAttribute('aria-pressed')"), "false");
    EXPECT_EQ(color(0.23, 0.23)[3], 0);
    mouse({move(at(0.3, 0.5))});
    EXPECT_THAT(reading(), Not(HasSubstr("ramp")));
    EXPECT_THAT(reading(), HasSubstr("down: 14"));
    browser.click(".entry");
    EXPECT_GT(color(0.23, 0.23)[3], 100);
}

TEST_F(page_figures, panels_over_the_same_time_go_together_and_logarithms_stay_so) {
    Figure figure = ramps();
    figure.rows = 3;
    figure.panels.push_back(figure.panels[0]);
    figure.panels.push_back(figure.panels[0]);
    Panel& last = figure.panels[2];
    last.log_x = true;
    last.x_range = {0.1, 100};
    make(figure);
    open();
    mouse({move(at(0.2, 0.5)), down(), move(at(0.6, 0.505)), up()});
    EXPECT_EQ(value("plot.panels[1].x.low === panel.x.low && plot.panels[1].x.high === panel.x.high"), true);
    EXPECT_EQ(value("plot.panels[2].x.moved"), false);
    browser.evaluate("window.panel = plot.panels[2]");
    mouse({move(at(1.0 / 3, 0.5)), down(), move(at(2.0 / 3, 0.505)), up()});
    EXPECT_NEAR(value("Math.log10(panel.x.low)"), 0, 0.02);  // decades of the same length
    EXPECT_NEAR(value("Math.log10(panel.x.high)"), 1, 0.02);
    EXPECT_EQ(value("panel.x.marks(5).ticks.map(t => t[0]).includes(5)"), true);
}

TEST_F(page_figures, clouds_are_read_point_by_point_and_french_has_commas) {
    Panel panel;
    panel.x_label = Message("a_{1}"), panel.y_label = Message("a_{2}");
    Curve cloud;
    cloud.style = CurveStyle::kPoints;
    cloud.x = Vector{{4.0, 4.25, 3.5}};
    cloud.y = Vector{{3.0, 3.5, 2.75}};
    cloud.label = Message("IVSVF");
    panel.curves = {cloud};
    panel.x_range = {3, 5}, panel.y_range = {2, 4};
    make(Figure(panel), "fr");
    open();
    mouse({move(at(0.62, 0.76))});
    EXPECT_THAT(reading(), HasSubstr("IVSVF"));
    EXPECT_THAT(reading(), HasSubstr("a1: 4,250"));
    EXPECT_THAT(reading(), HasSubstr("a2: 3,500"));
}

}  // namespace test_page_figures
