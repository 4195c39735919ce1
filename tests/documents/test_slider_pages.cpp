// Pages whose sliders move without a server, in a real browser. Oracle: the run results for each position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "documents/html/plot_data.h"
#include "documents/html/slider_page.h"
#include "figures/figure.h"
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

TEST(slider_places, of_one_cell_are_not_too_many_together) {
    RunRecord record;
    for (const std::string name : {"a", "b", "c"}) record.sliders[name] = slider_from(0, 100, 1, 50);
    for (auto& [name, slider] : record.sliders) slider.cell = "one";
    const std::vector<SliderGroup> three = slider_groups(record);
    ASSERT_EQ(three.size(), 1u);
    EXPECT_LE(three[0].combinations().size(), 512u);
    EXPECT_GE(three[0].combinations().size(), 343u);
    for (const PlacedSlider& slider : three[0].sliders) {
        EXPECT_EQ(slider.values.front(), 0);
        EXPECT_EQ(slider.values.back(), 100);
        EXPECT_EQ(slider.values[slider.shown], 50);
    }
    record.sliders["c"].cell = "another", record.sliders["c"].order = 7;
    const std::vector<SliderGroup> two = slider_groups(record);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[1].cell, "another");
    EXPECT_GE(two[1].combinations().size(), 25u);
    EXPECT_EQ(two[0].combinations()[1], (std::vector<std::size_t>{0, 1}));  // the last slider is the quickest
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

    /// The run with k and c of one cell and b of another: y = k x, the gain k + 10 c + 100 b, and a mark at
    /// (0.2 + 0.3 c, k), which moves both.
    DocumentSource document(double k, double c, double b) {
        RunRecord& record = records_.emplace_back();
        record.script = "analysis.lua";
        record.sliders = {
            {"k", slider_from(1, 3, 1, k)}, {"c", slider_from(0, 2, 1, c)}, {"b", slider_from(0, 1, 1, b)}};
        record.sliders["k"].unit = "V", record.sliders["k"].label = "gain k";
        for (const auto& [name, place] : {std::pair<std::string, std::size_t>{"k", 0}, {"c", 1}, {"b", 2}})
            record.sliders[name].order = place, record.sliders[name].cell = place < 2 ? "ask" : "draw";
        const double gain = k + 10 * c + 100 * b;
        record.values["gain"] = {gain, says_gain_ ? json(gain).dump() : "large"};
        Panel panel;
        panel.x_range = {0, 1}, panel.y_range = {0, 4};
        panel.curves.emplace_back();
        panel.curves[0].x = Vector::LinSpaced(11, 0, 1);
        panel.curves[0].y = k * panel.curves[0].x;
        if (has_legend_)
            panel.curves[0].label = Message("line"), panel.title = Message::verbatim(k == 3 ? "Steep\nindeed" : "");
        const Vector of_k = Vector::LinSpaced(21, 1, 3), of_c = Vector::LinSpaced(21, 0, 2);
        panel.annotations.push_back(
            {0.2 + 0.3 * c,
             k,
             Message("end"),
             true,
             {{"c", true, c, of_c, (0.2 + 0.3 * of_c.array()).matrix()}, {"k", false, k, of_k, of_k}}});
        RecordedFigure& figure = record.figures["draw-figure-1"];
        figure.caption = "A line";
        figure.file = folder_.path() / "drawn.svg";
        figure.plot = plot_data(Figure(panel));
        if (draws_twice_) {
            record.figures["draw-figure-2"] = figure;
            record.figures["draw-figure-2"].caption = "A line again, gain " + json(k).dump();
        }
        record.outputs["draw"] = {{says_gain_ ? "k is " + json(k).dump() + "\n" : "", std::nullopt},
                                  {"", "draw-figure-1"}};
        if (draws_twice_) record.outputs["draw"].push_back({"", "draw-figure-2"});
        if (k == 3 && says_more_) record.outputs["draw"].push_back({"It is large.\n", std::nullopt});
        DocumentSource source;
        source.template_file = folder_.path() / "report.md";
        source.record = &record;
        source.cells = weave_cells(script_, record);
        return source;
    }
    void open() {
        const DocumentSource run = document(2, 0, 0);
        const std::vector<SliderGroup> groups = slider_groups(*run.record);
        ASSERT_EQ(groups.size(), 2u);
        const fs::path page = folder_.path() / "page.html";
        DocumentMaker({.use_cache = false}).make(run, page, DocumentFormat::kHtml, nullptr);
        SliderPage made(run, script_, groups);
        for (double k : {1, 2, 3})
            for (double c : {0, 1, 2})
                if (k != 2 || c != 0) made.add(0, document(k, c, 0));
        made.add(1, document(2, 0, 1));
        write_file_atomically(page, made.page(read_file(page)));
        browser.open("file://" + page.string());
        ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.slider input').length === 3"));
        ASSERT_TRUE(browser.becomes_true("document.querySelector('div.plot')"));
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    bool shows(const std::string& text) {
        return browser.becomes_true("document.querySelector('main').innerText.includes('" + text + "')");
    }
    void move(const std::string& name, int place) {
        browser.evaluate("const input = document.getElementById('slider-" + name +
                         "'); input.value = " + std::to_string(place) + "; input.dispatchEvent(new Event('input'))");
    }
    double slope() { return value("document.querySelector('div.plot').plot.panels[0].curves[0].y[10]"); }

    /// The middle of a handle, in pixels of the window.
    std::pair<int, int> handle(int number) {
        const json at =
            value("(() => { const handle = document.querySelectorAll('.handle')[" + std::to_string(number) +
                  "]; handle.scrollIntoView({block: 'center'}); "
                  "const box "
                  "= handle.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2] })()");
        return {static_cast<int>(at[0].get<double>()), static_cast<int>(at[1].get<double>())};
    }
    /// Drags a handle to other places, given relative to the handle.
    void drag(const std::string& kind, const std::vector<std::pair<double, double>>& places, int number = 0) {
        const auto [x, y] = handle(number);
        const json scale = value(
            "(() => { const { plot } = document.querySelector('div.plot'), panel = plot.panels[0]; "
            "return [plot.unit * panel.width, plot.unit * panel.height / 4] })()");
        const auto move = [&](double across, double up) {
            return json{{"type", "pointerMove"},
                        {"duration", 20},
                        {"x", static_cast<int>(x + across * scale[0].get<double>())},
                        {"y", static_cast<int>(y - up * scale[1].get<double>())}};
        };
        json actions = {move(0, 0), {{"type", "pointerDown"}, {"button", 0}}};
        for (const auto& [across, up] : places) actions.push_back(move(across, up));
        actions.push_back({{"type", "pointerUp"}, {"button", 0}});
        browser.act(
            json::array(
                {{{"type", "pointer"}, {"id", kind}, {"parameters", {{"pointerType", kind}}}, {"actions", actions}}})
                .dump());
    }
    std::string place(const std::string& name) {
        return value("document.querySelector('.slider:has(#slider-" + name + ") output').textContent");
    }
    void press(const std::string& key) {
        browser.act(
            json::array({{{"type", "key"},
                          {"id", "keys"},
                          {"actions", {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}}}}})
                .dump());
    }

    bool says_gain_ = true, says_more_ = false, draws_twice_ = false, has_legend_ = false;
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

TEST_F(slider_pages, those_of_one_cell_are_moved_together) {
    open();
    move("k", 0);
    EXPECT_TRUE(shows("The gain is 1."));
    move("c", 2);
    EXPECT_TRUE(shows("The gain is 21."));
    EXPECT_EQ(slope(), 1);
    move("k", 2);
    EXPECT_TRUE(shows("The gain is 23."));
    move("c", 0);
    move("k", 1);
    EXPECT_TRUE(shows("The gain is 2."));
}

TEST_F(slider_pages, those_of_other_cells_go_back_and_the_way_back_is_a_button) {
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

TEST_F(slider_pages, a_place_may_say_more_than_another) {
    says_more_ = true;
    open();
    EXPECT_EQ(value("document.querySelector('main').innerText.includes('It is large.')"), false);
    move("k", 2);
    EXPECT_TRUE(shows("It is large."));
    EXPECT_TRUE(shows("Words that stay."));
    EXPECT_EQ(slope(), 3);
    EXPECT_EQ(value("document.querySelectorAll('div.plot').length"), 1);
    move("k", 1);
    EXPECT_EQ(value("document.querySelector('main').innerText.includes('It is large.')"), false);
    EXPECT_EQ(value("document.querySelectorAll('div.plot').length"), 1);
    EXPECT_EQ(slope(), 2);
}

TEST_F(slider_pages, a_hand_takes_a_handle_to_the_nearest_places) {
    open();
    EXPECT_EQ(value("document.querySelectorAll('.handle').length"), 1);
    drag("mouse", {{0.1, 0.1}, {0.27, 1.1}});
    EXPECT_EQ(place("k"), "3\u202fV");
    EXPECT_EQ(place("c"), "1");
    EXPECT_EQ(slope(), 3);
    EXPECT_TRUE(shows("The gain is 13."));
    EXPECT_EQ(value("document.querySelectorAll('.held').length"), 0);
    drag("mouse", {{-0.1, -1}, {0.9, -3}});  // beyond all ends, then let go
    EXPECT_EQ(place("k"), "1\u202fV");
    EXPECT_EQ(place("c"), "2");
    drag("touch", {{-0.3, 0}, {-0.3, 0.9}});
    EXPECT_EQ(place("k"), "2\u202fV");
    EXPECT_EQ(place("c"), "1");
    // The slider does not move after its release.
    browser.act(json::array({{{"type", "pointer"},
                              {"id", "mouse"},
                              {"actions", {{{"type", "pointerMove"}, {"duration", 0}, {"x", 300}, {"y", 300}}}}}})
                    .dump());
    EXPECT_EQ(place("c"), "1");
}

TEST_F(slider_pages, a_handle_is_found_where_the_figure_was_zoomed) {
    says_gain_ = false;
    open();
    browser.evaluate(
        "const { plot } = document.querySelector('div.plot'); plot.zoom(plot.panels[0], [0, 0.5], [0.25, 0.75])");
    const json before = value("document.querySelector('div.plot').plot.panels[0].y.high");
    drag("mouse", {{0.1, 0.1}, {0.6, 2.1}});  // twice as far on the screen
    EXPECT_EQ(place("k"), "3\u202fV");
    EXPECT_EQ(place("c"), "1");
    EXPECT_EQ(value("document.querySelector('div.plot').plot.panels[0].y.high"), before);
}

TEST_F(slider_pages, keys_move_a_handle_step_by_step) {
    open();
    browser.evaluate("document.querySelector('.handle').focus()");
    press("\uE013");  // up
    EXPECT_EQ(place("k"), "3\u202fV");
    press("\uE014");  // right
    press("\uE014");
    press("\uE014");  // there is no further place
    EXPECT_EQ(place("c"), "2");
    press("\uE012");  // left
    EXPECT_EQ(place("c"), "1");
    EXPECT_EQ(value("document.activeElement.className"), "handle");
    EXPECT_EQ(value("document.activeElement.getAttribute('aria-label')"), "end, c = 1, k = 3");
}

/// Marks of one name in two figures, whose text differs at each place: a drag keeps the mark that it started with.
TEST_F(slider_pages, a_hand_keeps_the_handle_of_its_figure) {
    draws_twice_ = true;
    open();
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.handle').length === 2"));
    drag("mouse", {{0, 0.6}, {0, 0.8}, {0, 1}}, 1);
    EXPECT_TRUE(shows("A line again, gain 3"));
    EXPECT_EQ(place("k"), "3\u202fV");
    browser.evaluate("document.querySelectorAll('.handle')[1].focus()");
    press("\uE015");  // down
    EXPECT_TRUE(shows("A line again, gain 2"));
    EXPECT_EQ(value("[...document.querySelectorAll('.handle')].indexOf(document.activeElement)"), 1);
}

TEST_F(slider_pages, open_tables_show_the_samples_of_the_place) {
    open();
    browser.click(".plot .data");
    const std::string last = "document.querySelector('.samples tbody tr:last-child').innerText";
    EXPECT_EQ(value(last), "1\t2");
    move("k", 2);
    EXPECT_EQ(value(last), "1\t3");
    browser.evaluate(
        "Object.defineProperty(navigator, 'clipboard', {value: {writeText: text => { window.copied = text; }}});"
        "document.querySelector('.samples .csv').click()");
    ASSERT_TRUE(browser.becomes_true("window.copied !== undefined"));
    EXPECT_TRUE(value("copied.endsWith('\\n1,3\\n')")) << value("copied");
    browser.click(".plot .data");
    EXPECT_EQ(value("document.querySelectorAll('.samples').length"), 0);
    move("k", 0);
    EXPECT_EQ(value("document.querySelectorAll('.samples').length"), 0);
}

TEST_F(slider_pages, hidden_curves_stay_so_and_their_buttons_say_it) {
    says_gain_ = false, has_legend_ = true;
    open();
    browser.evaluate("document.querySelector('.entry').focus()");
    press(" ");
    const std::string entry = "document.querySelector('.entry')";
    ASSERT_EQ(value(entry + ".getAttribute('aria-pressed')"), "false");
    move("k", 0);
    EXPECT_EQ(value("document.querySelector('div.plot').plot.panels[0].curves[0].shown"), false);
    EXPECT_EQ(value(entry + ".getAttribute('aria-pressed')"), "false");
    EXPECT_EQ(value("document.activeElement === " + entry), true);
    press(" ");
    EXPECT_EQ(value("document.querySelector('div.plot').plot.panels[0].curves[0].shown"), true);
    EXPECT_EQ(value(entry + ".getAttribute('aria-pressed')"), "true");
}

/// A place whose title is longer has a higher figure: a centimetre stays a centimetre both ways.
TEST_F(slider_pages, figures_take_the_room_of_the_place) {
    says_gain_ = false, has_legend_ = true;
    open();
    const std::string off =
        "(plot => Math.abs(plot.box.offsetHeight / plot.box.offsetWidth - plot.size[1] / plot.size[0]))"
        "(document.querySelector('div.plot').plot)";
    const double height = value("document.querySelector('div.plot').plot.size[1]");
    EXPECT_LT(value(off), 0.003);
    move("k", 2);
    ASSERT_GT(value("document.querySelector('div.plot').plot.size[1]").get<double>(), height + 0.3);
    EXPECT_LT(value(off), 0.003);
    move("k", 1);
    EXPECT_EQ(value("document.querySelector('div.plot').plot.size[1]"), height);
    EXPECT_LT(value(off), 0.003);
}

/// Figures without other words cost what is drawn otherwise, not the page's pictures and texts again.
TEST_F(slider_pages, of_a_figure_only_what_differs_is_kept) {
    says_gain_ = false;
    open();
    const json kept = value("JSON.parse(document.querySelector('.slider-places').textContent)[0].pieces");
    ASSERT_EQ(kept.size(), 1u);
    const json places = kept.front();
    ASSERT_EQ(places.size(), 9u);
    EXPECT_TRUE(places[3].is_null());  // that of the run
    EXPECT_EQ(places[0][0]["panels"]["0"]["curves"]["0"]["y"][0][10], 1);
    EXPECT_FALSE(places[0][0]["panels"]["0"]["curves"]["0"].contains("x"));
    EXPECT_FALSE(places[0][0]["panels"]["0"].contains("box"));
    EXPECT_FALSE(places[4][0]["panels"]["0"].contains("curves"));  // c moves the mark alone
    move("c", 2);
    EXPECT_NEAR(value("document.querySelector('div.plot').plot.panels[0].marks[0][0]"), 0.8, 1e-9);
    EXPECT_EQ(slope(), 2);
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
