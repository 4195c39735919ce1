// What lessons say of the workbench is done as it is written, and photographed: DYNLAB_PICTURES=1 puts the photographs
// into the lessons. Oracle: the lessons' text, and the script that the clicks leave.
#include <gmock/gmock.h>

#include <cstdlib>

#include "platform/atomic_file.h"
#include "support/workbench.h"

namespace test_workbench_lessons {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
namespace fs = std::filesystem;

class workbench_lessons : public workbench_page {
  protected:
    fs::path lesson(const std::string& name) const { return fs::path(DYNLAB_SOURCE_DIR) / "lessons" / name; }
    /// Clicks what the lesson prints in bold.
    void press_as_described(Browser& browser, const std::string& text, const std::string& words) const {
        EXPECT_THAT(text, HasSubstr("**" + words + "**"));
        ASSERT_TRUE(press(browser, words)) << words;
        ASSERT_TRUE(is_ready(browser)) << words;
    }
    void open_as_described(Browser& browser, const std::string& text, const std::string& words) const {
        EXPECT_THAT(text, HasSubstr("**" + words + "**"));
        browser.evaluate(
            "[...document.querySelectorAll('#steps summary')].filter((one) => one.textContent.startsWith('" + words +
            "')).forEach((one) => { one.parentNode.open = true; })");
    }
    /// Chooses a value that the lesson names, in the first list that has it.
    void choose(Browser& browser, const std::string& text, const std::string& value, const std::string& list) const {
        EXPECT_THAT(text, HasSubstr("`" + value + "`"));
        browser.evaluate("const list = " + list +
                         "; list.value = [...list.options].find((one) => [one.value.replaceAll('\"', ''), "
                         "one.textContent].includes('" +
                         value + "')).value; list.dispatchEvent(new Event('change'))");
        ASSERT_TRUE(is_ready(browser)) << value;
    }
    /// A page as wide as a picture of the lessons may be, with more dots than a screen has.
    void as_on_paper(Browser& browser, int width, int height) const {
        browser.devtools("Emulation.setDeviceMetricsOverride", "{\"width\":" + std::to_string(width) +
                                                                   ",\"height\":" + std::to_string(height) +
                                                                   ",\"deviceScaleFactor\":1.5,\"mobile\":false}");
    }
    /// The smallest visible type, in mm, where the page is 160 mm wide.
    double smallest_type(Browser& browser) const {
        return std::stod(browser.evaluate(
            "const seen = [...document.querySelectorAll('body *')].filter((one) => {"
            "  const box = one.getBoundingClientRect();"
            "  return [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim()) && box.width > 0 &&"
            "    box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth; });"
            "return Math.min(...seen.map((one) => parseFloat(getComputedStyle(one).fontSize))) * 160 / innerWidth"));
    }
    void photograph(Browser& browser, const fs::path& picture) const {
        const fs::path taken = file("taken.png");
        EXPECT_GT(smallest_type(browser), 2.1) << "six points";
        browser.evaluate("document.getElementById('views').scrollTop = 0");
        browser.photograph(taken);
        if (std::getenv("DYNLAB_PICTURES") != nullptr)
            fs::copy_file(taken, picture, fs::copy_options::overwrite_existing);
        const auto width = [](const fs::path& png) {
            const std::string bytes = read_file(png);
            return bytes.substr(16, 8);  // width and height in the header
        };
        ASSERT_TRUE(fs::exists(picture));
        EXPECT_EQ(width(picture), width(taken));
    }
};

const std::string kMethod =
    "[...document.querySelectorAll('#steps label')].find((one) => "
    "one.textContent.trim().startsWith('Method')).querySelector('select')";

TEST_F(workbench_lessons, the_heat_exchanger_of_lesson_1) {
    const std::string text = read_text(lesson("01_process_models") / "lesson.lua");
    EXPECT_THAT(text, HasSubstr("`dynlab app heat_exchanger`"));
    const auto program = app("heat_exchanger");
    Browser browser(760, 780);
    as_on_paper(browser, 760, 780);
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    open_as_described(browser, text, "Read by hand");
    press_as_described(browser, text, "First order");
    EXPECT_THAT(text, HasSubstr("**Method**"));
    choose(browser, text, "procsrivc", kMethod);
    press_as_described(browser, text, "New model");
    ASSERT_TRUE(script_has(browser, "procsrivc(estimation, \"P2D\")"));
    choose(browser, text, "P1", "document.querySelector('.chosen .orders select')");
    EXPECT_THAT(text, HasSubstr("`D`"));
    ASSERT_TRUE(script_has(browser, "\"P1D\""));
    browser.evaluate("document.querySelector('.chosen .orders input[type=checkbox]').click()");
    ASSERT_TRUE(script_has(browser, "procsrivc(estimation, \"P1\")"));
    open_as_described(browser, text, "Options");
    choose(browser, text, "steady",
           "[...document.querySelectorAll('.chosen label')].find((one) => "
           "one.textContent.startsWith('InitialState')).querySelector('select')");
    EXPECT_TRUE(script_has(browser, "G1 = procsrivc(estimation, \"P1\", {InitialState = \"steady\"})"));
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "[...document.querySelectorAll('#steps summary')].find((one) => one.textContent.startsWith('Read by "
        "hand')).scrollIntoView(true)");
    photograph(browser, lesson("01_process_models") / "workbench.png");
}

TEST_F(workbench_lessons, the_known_system_of_lesson_4) {
    const std::string text = read_text(lesson("04_estimators") / "lesson.lua");
    const auto program = app("");
    Browser browser(760, 740);
    as_on_paper(browser, 760, 740);
    browser.open(program->address());
    ASSERT_TRUE(is_ready(browser));
    open_as_described(browser, text, "Known system");
    press_as_described(browser, text, "Start study");
    ASSERT_TRUE(view_appears(browser, "study"));
    for (const char* words : {"noise", "estimators"}) EXPECT_THAT(text, HasSubstr("**" + std::string(words) + "**"));
    EXPECT_THAT(text, HasSubstr("`lssvf = {{2, 1, 0}, 3}`"));
    browser.evaluate(
        "const field = [...document.querySelectorAll('#steps label')].find((one) => "
        "one.textContent.trim().startsWith('estimators')).querySelector('textarea');"
        "field.value = '{lssvf = {{2, 1, 0}, 3}, srivc = {{1, 2, 0}, {lambda = 3}}}'; field.dispatchEvent(new "
        "Event('change'))");
    ASSERT_TRUE(
        browser.becomes_true("document.querySelector('.tile[data-view=study] table')?.textContent.includes('lssvf')"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "[...document.querySelectorAll('#steps summary')].find((one) => one.textContent === 'Known "
        "system').scrollIntoView(true)");
    photograph(browser, lesson("04_estimators") / "workbench.png");
}

TEST_F(workbench_lessons, the_record_of_a_lesson_is_opened_by_the_lesson_s_name) {
    const auto program = app("03_crane");
    Browser browser;
    browser.open(program->address());
    EXPECT_TRUE(view_appears(browser, "record"));
    EXPECT_THAT(text_of("03_crane_session.lua"), HasSubstr("load(\"crane"));
}

}  // namespace test_workbench_lessons
