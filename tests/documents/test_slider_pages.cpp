// Pages whose sliders move without a server, in a real browser. Oracle: what the records say at each place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "documents/html/plot_data.h"
#include "documents/html/slider_page.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"

namespace test_slider_pages {
using namespace dynlab;
using nlohmann::json;
using test::Browser;
namespace fs = std::filesystem;

RecordedSlider slider_from(double from, double to, std::optional<double> step, double value) {
    RecordedSlider slider;
    slider.from = from, slider.to = to, slider.step = step, slider.value = slider.initial = value;
    return slider;
}

TEST(slider_places, are_the_steps_with_both_ends) {
    EXPECT_EQ(places_of(slider_from(0, 2, 0.5, 1)), (std::vector<double>{0, 0.5, 1, 1.5, 2}));
    EXPECT_EQ(places_of(slider_from(0.1, 0.3, 0.1, 0.2)), (std::vector<double>{0.1, 0.2, 0.3}));
    const std::vector<double> many = places_of(slider_from(0, 1000, 1, 333));
    EXPECT_LE(many.size(), 26u);
    EXPECT_EQ(many.front(), 0);
    EXPECT_EQ(many.back(), 1000);
    EXPECT_NE(std::find(many.begin(), many.end(), 333), many.end());
}

TEST(slider_places, are_spread_evenly_or_over_the_logarithm_without_steps) {
    RecordedSlider slider = slider_from(0.1, 10, {}, 1);
    const std::vector<double> even = places_of(slider);
    EXPECT_NEAR(even[1] - even[0], 9.9 / 20, 1e-3);
    slider.logarithmic = true;
    const std::vector<double> decades = places_of(slider);
    ASSERT_EQ(decades.size(), 21u);
    for (std::size_t i = 0; i + 1 < decades.size(); ++i)
        EXPECT_NEAR(decades[i + 1] / decades[i], std::pow(100, 1.0 / 20), 2e-3);
}

class slider_pages : public testing::Test {
  protected:
    slider_pages() {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        write("report.md", "---\ntitle: Sliders\n---\n\n::: {.cells}\n:::\n");
        script_ = parse_percent_script(
            "-- %% [markdown]\n-- The gain is `gain`{.value}.\n--\n-- Words that stay.\n\n-- %% id=ask\nlocal k = "
            "slider(\"k\", 2, 1, 3)\n\n-- %% id=draw\nprint(\"k is \" .. k)\n",
            folder_.path() / "analysis.lua");
        write("drawn.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"529\" height=\"300\"></svg>\n");
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }

    /// The run with k and a slider b: y = k x, the gain k + 100 b.
    DocumentSource document(double k, double b) {
        RunRecord& record = records_.emplace_back();
        record.script = "analysis.lua";
        const std::string gain = json(k + 100 * b).dump();
        record.values["gain"] = {k + 100 * b, gain};
        Panel panel;
        panel.x_range = {0, 1}, panel.y_range = {0, 3};
        panel.curves.emplace_back();
        panel.curves[0].x = Vector::LinSpaced(11, 0, 1);
        panel.curves[0].y = k * panel.curves[0].x;
        RecordedFigure& figure = record.figures["draw-figure-1"];
        figure.caption = "A line";
        figure.file = folder_.path() / "drawn.svg";
        figure.plot = plot_data(Figure(panel), false);
        record.outputs["draw"] = {{"k is " + json(k).dump() + "\n", std::nullopt}, {"", "draw-figure-1"}};
        DocumentSource source;
        source.template_file = folder_.path() / "report.md";
        source.record = &record;
        source.cells = weave_cells(script_, record);
        return source;
    }
    void open() {
        RecordedSlider k = slider_from(1, 3, 1, 2), b = slider_from(0, 1, 1, 0);
        k.cell = b.cell = "ask", k.label = "gain k", k.unit = "V", b.label = "b", b.order = 1;
        const std::vector<SliderPlaces> sliders = {
            {"k", k, {1, 2, 3}, {document(1, 0), document(2, 0), document(3, 0)}, 1},
            {"b", b, {0, 1}, {document(2, 0), document(2, 1)}, 0}};
        const fs::path page = folder_.path() / "page.html";
        DocumentMaker({.use_cache = false}).make(sliders[0].documents[1], page, DocumentFormat::kHtml, nullptr);
        write_file_atomically(page, page_with_sliders(read_file(page), script_, sliders));
        browser.open("file://" + page.string());
        ASSERT_TRUE(browser.comes("document.querySelectorAll('.slider input').length === 2"));
        ASSERT_TRUE(browser.comes("document.querySelector('div.plot')"));
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    bool shows(const std::string& text) {
        return browser.comes("document.querySelector('main').innerText.includes('" + text + "')");
    }
    void move(const std::string& name, int place) {
        browser.evaluate("const input = document.getElementById('slider-" + name +
                         "'); input.value = " + std::to_string(place) + "; input.dispatchEvent(new Event('input'))");
    }
    double slope() { return value("document.querySelector('div.plot').plot.panels[0].curves[0].y[10]"); }

    TemporaryFolder folder_;
    PercentScript script_;
    std::deque<RunRecord> records_;
    Browser browser;
};

TEST_F(slider_pages, show_what_the_document_says_at_the_place) {
    open();
    EXPECT_TRUE(shows("The gain is 2."));
    EXPECT_EQ(slope(), 2);
    EXPECT_EQ(value("document.querySelector('.slider output').textContent"), "2\u202fV");
    browser.evaluate(
        "window.stays = [...document.querySelectorAll('p')].find(p => p.textContent === 'Words that stay.')");
    move("k", 2);
    EXPECT_TRUE(shows("The gain is 3."));
    EXPECT_TRUE(shows("k is 3"));
    EXPECT_EQ(slope(), 3);
    EXPECT_EQ(value("stays.isConnected"), true);
    EXPECT_EQ(value("document.querySelectorAll('div.plot').length"), 1);
    move("k", 1);
    EXPECT_TRUE(shows("The gain is 2."));
    EXPECT_EQ(slope(), 2);
}

TEST_F(slider_pages, one_is_moved_at_a_time_and_the_way_back_is_a_button) {
    open();
    move("k", 0);
    EXPECT_TRUE(shows("The gain is 1."));
    move("b", 1);
    EXPECT_TRUE(shows("The gain is 102"));
    EXPECT_EQ(value("document.getElementById('slider-k').value"), "1");
    browser.click(".slider:has(#slider-b) button");
    EXPECT_TRUE(shows("The gain is 2."));
    EXPECT_EQ(value("document.querySelector('.slider:has(#slider-b) button').hidden"), true);
}

TEST_F(slider_pages, controls_stand_behind_their_cell_and_are_not_printed) {
    open();
    EXPECT_EQ(
        value("(() => { const place = node => [...document.querySelectorAll('main *')].indexOf(node); const code = "
              "[...document.querySelectorAll('pre')]; const slider = document.querySelector('.slider'); return "
              "place(code[0]) < place(slider) && place(slider) < place(code[1]) })()"),
        true);
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": "print"})");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.slider')).display"), "none");
    move("k", 0);
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.moved div.plot')).display"), "inline-block");
}

}  // namespace test_slider_pages
