// Animated plants on a page, in a real browser. Oracle: their geometry by hand, searched for among the pixels, and the
// signals that the test wrote.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/languages.h"
#include "documents/document.h"
#include "documents/html/plot_data.h"
#include "figures/plots/motion_plot.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"

namespace test_motion_pages {
using namespace dynlab;
using nlohmann::json;
using test::Browser;
using testing::HasSubstr;

/// 6 cm x 3 cm: a block of 1 cm that slides 1 cm per meter and is at x = 1.5 cm at 0 m. Measured: t/4 m. Simulated: 2
/// m.
Figure sliding_block() {
    PlantDrawing rig;
    rig.width = 6, rig.height = 3;
    rig.parts = {{"position", "m", -1, false, 1, 0, 1, 0}};
    rig.pieces = {{{0, 6}, {0.5, 0.5}, {-1, -1}, false, 1.1},
                  {{1, 2, 2, 1}, {1, 1, 2, 2}, {0, 0, 0, 0}, true, 1},
                  {{1, 2, 2, 1, 1}, {1, 1, 2, 2, 1}, {0, 0, 0, 0, 0}, false, 0.5}};
    MotionData motion_data;
    motion_data.t = Vector::LinSpaced(501, 0, 10);
    motion_data.measured = motion_data.t / 4, motion_data.simulated = Matrix::Constant(501, 1, 3);
    MotionAppearance look;
    look.title = Message("A block");
    return motion_plot(rig, motion_data, look);
}

class motion_pages : public testing::Test {
  protected:
    void make(const std::string& language = "en") {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        RecordedFigure recorded;
        recorded.caption = "A block";
        recorded.file = folder.path() / "block.svg";
        recorded.plot = plot_data(sliding_block(), {catalog_of(language)});
        std::ofstream(recorded.file) << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"500\" height=\"250\"/>\n";
        record.figures["block"] = recorded;
        std::ofstream(folder.path() / "report.md")
            << "---\ntitle: Block\nlang: " << language << "\n---\n\n![](figure:block)\n\n"
            << std::string(3000, 'w') << "\n\n"
            << [] {
                   std::string lines;
                   for (int i = 0; i < 80; ++i) lines += "A line.\n\n";
                   return lines;
               }();
        DocumentSource source;
        source.template_file = folder.path() / "report.md";
        source.record = &record;
        DocumentMaker({.use_cache = false}).make(source, page(), DocumentFormat::kHtml, nullptr);
    }
    std::filesystem::path page() const { return folder.path() / "page.html"; }
    void open() {
        browser.open("file://" + page().string());
        ASSERT_TRUE(browser.becomes_true("document.querySelector('.motion') !== null"));
        browser.evaluate("window.motion = document.querySelector('.motion').motion");
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    double now() { return value("motion.now"); }
    /// Red, green, blue, cover of the stage at a place of the drawing, cm.
    json color(double x, double y) {
        return value(
            fmt::format("(() => {{ const u = motion.stage.width / (6 + 0.6); return [...motion.stage.getContext('2d')"
                        ".getImageData(Math.round(({} + 0.3) * u), Math.round((3 + 0.3 - {}) * u), 1, 1).data]; }})()",
                        x, y));
    }
    void press(const std::string& key) {
        const json actions = {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}};
        browser.act(json::array({{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}).dump());
    }

    TemporaryFolder folder;
    RunRecord record;
    Browser browser;
};

const char* const kRight = "\uE014";
const char* const kTab = "\uE004";

TEST_F(motion_pages, parts_stand_where_their_signals_say) {
    make();
    open();
    EXPECT_EQ(value("motion.playing"), false) << "nothing starts by itself";
    EXPECT_EQ(now(), 0);
    browser.evaluate("motion.show(4)");  // measured 1 m, simulated 3 m
    const json measured = color(2.5, 1.5), simulated = color(4.5, 1.5);
    EXPECT_NEAR(measured[0].get<int>(), 0x8C, 3) << measured;  // the grey of the data
    EXPECT_NEAR(measured[2].get<int>(), 0x8C, 3) << measured;
    EXPECT_NEAR(simulated[0].get<int>(), 0x00, 3) << simulated;  // the first color of the palette
    EXPECT_NEAR(simulated[2].get<int>(), 0xB2, 3) << simulated;
    EXPECT_EQ(color(1.5, 1.5)[3], 0) << "it has left its place";
    EXPECT_EQ(color(3.25, 1.5)[3], 0);
    EXPECT_GT(color(5.9, 0.5)[3], 100) << "the floor";
}

TEST_F(motion_pages, describe_in_words_what_they_show) {
    make();
    open();
    browser.evaluate("motion.show(4)");
    EXPECT_EQ(value("motion.values.innerText"), "position: ● measured 1.000 m, ● simulated 3.000 m");
    for (const char* where :
         {"motion.scrubber.getAttribute('aria-valuetext')", "motion.stage.getAttribute('aria-label')"}) {
        EXPECT_THAT(value(where).get<std::string>(),
                    HasSubstr("4.000 s; position: measured 1.000 m, simulated 3.000 m"));
    }
    EXPECT_EQ(value("motion.stage.getAttribute('role')"), "img");
    make("fr");
    open();
    browser.evaluate("motion.show(4)");
    EXPECT_EQ(value("motion.values.innerText"), "position: ● mesuré 1,000 m, ● simulé 3,000 m");
    EXPECT_EQ(value("motion.button.innerText"), "Lecture");
}

TEST_F(motion_pages, play_in_real_time_or_slower_and_pause) {
    make();
    open();
    browser.click(".motion button");
    EXPECT_EQ(value("motion.button.innerText"), "Pause");
    browser.evaluate("window.from = [performance.now(), motion.now]");
    ASSERT_TRUE(browser.becomes_true("motion.now > 1"));
    const json passed = value("[(performance.now() - from[0]) / 1000, motion.now - from[1]]");
    EXPECT_NEAR(passed[1].get<double>(), passed[0].get<double>(), 0.3);
    browser.click(".motion button");
    const double at = now();
    EXPECT_FALSE(browser.becomes_true("motion.playing", 0.3));
    EXPECT_EQ(now(), at);
    browser.evaluate(
        "motion.select.value = '0.1'; motion.select.dispatchEvent(new Event('change')); motion.play();"
        "window.from = [performance.now(), motion.now]");
    EXPECT_FALSE(browser.becomes_true("false", 1));
    const json slower = value("[(performance.now() - from[0]) / 1000, motion.now - from[1]]");
    EXPECT_NEAR(slower[1].get<double>(), 0.1 * slower[0].get<double>(), 0.05);
}

TEST_F(motion_pages, keep_their_pace_when_the_button_is_pressed_again_and_again) {
    make();
    open();
    browser.evaluate(
        "for (let i = 0; i < 7; ++i) document.querySelector('.motion button').click();"
        "window.from = [performance.now(), motion.now]");
    EXPECT_EQ(value("motion.playing"), true);
    EXPECT_FALSE(browser.becomes_true("false", 1));
    const json passed = value("[(performance.now() - from[0]) / 1000, motion.now - from[1]]");
    EXPECT_NEAR(passed[1].get<double>(), passed[0].get<double>(), 0.3);
    EXPECT_THAT(value("motion.stage.getAttribute('aria-label')").get<std::string>(), HasSubstr(" 0.000 s"))
        << "while it moves nothing is read out";
    browser.click(".motion button");
    EXPECT_THAT(value("motion.stage.getAttribute('aria-label')").get<std::string>(),
                testing::Not(HasSubstr(" 0.000 s")));
}

TEST_F(motion_pages, end_where_the_record_ends_and_begin_again) {
    make();
    open();
    browser.evaluate("motion.show(9.9); motion.play()");
    EXPECT_TRUE(browser.becomes_true("motion.now === 10 && !motion.playing"));
    browser.evaluate("motion.play()");
    EXPECT_TRUE(browser.becomes_true("motion.now > 0 && motion.now < 5"));
}

TEST_F(motion_pages, obey_the_keyboard) {
    make();
    open();
    browser.evaluate("document.querySelector('.motion button').focus()");
    press(" ");
    EXPECT_TRUE(browser.becomes_true("motion.now > 0"));
    press(" ");
    EXPECT_EQ(value("motion.playing"), false);
    press(kTab);
    EXPECT_EQ(value("document.activeElement === motion.scrubber"), true);
    browser.evaluate("motion.show(4)");
    press(kRight);
    EXPECT_NEAR(now(), 4.02, 1e-9);
    press(" ");
    EXPECT_EQ(value("motion.playing"), true);
    press(kRight);
    EXPECT_EQ(value("motion.playing"), false) << "who takes the slider stops it";
}

TEST_F(motion_pages, stop_when_they_are_not_visible) {
    make();
    open();
    browser.evaluate("motion.play()");
    browser.evaluate("window.scrollTo(0, document.body.scrollHeight)");
    EXPECT_TRUE(browser.becomes_true("!motion.playing", 3));
    EXPECT_LT(now(), 8) << "it did not end with its record";
    browser.evaluate("window.scrollTo(0, 0)");
    EXPECT_FALSE(browser.becomes_true("motion.playing", 0.5)) << "and do not go on by themselves";
}

TEST_F(motion_pages, show_their_instant_in_the_figure_below) {
    make();
    open();
    browser.evaluate("window.plot = document.querySelector('.plot').plot; motion.show(5)");
    const auto cover = [&](double t) {
        return value(fmt::format("(() => {{ const p = plot.panels[1], d = devicePixelRatio, x = Math.round(plot.unit * "
                                 "p.place({}, 0)[0] * d), y = Math.round(plot.unit * (plot.size[1] - p.top + 0.1) * d);"
                                 "return Math.max(...[-1, 0, 1].map(i => plot.over.getContext('2d')"
                                 ".getImageData(x + i, y, 1, 1).data[3])); }})()",
                                 t))
            .get<int>();
    };
    EXPECT_GT(cover(5), 50);
    EXPECT_EQ(cover(7), 0);
    EXPECT_EQ(value("plot.readable.length"), 1) << "a picture is not read off";
}

TEST_F(motion_pages, are_not_printed) {
    make();
    open();
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": "print"})");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.motion')).display"), "none");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('figure img')).display"), "inline");
}

}  // namespace test_motion_pages
