// The page of the workbench: what a mistake leaves, what follows from an edit, and whether all of it can be reached.
// Oracle: the script on disk, what it says when it is run, and the page's own geometry and texts.
#include <gmock/gmock.h>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench_page {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Not;

class workbench_page_parts : public workbench_page {
  protected:
    static void press_all(Browser& browser, const std::vector<std::string>& words) {
        for (const std::string& one : words) {
            ASSERT_TRUE(press(browser, one)) << one;
            browser.becomes_true("document.getElementById('state').textContent === 'computing'", 0.2);
            ASSERT_TRUE(is_ready(browser)) << one;
        }
    }
    /// Replaces text in the editor of the script.
    static void type(Browser& browser, const std::string& before, const std::string& after) {
        browser.evaluate(
            "const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue().replace(`" + before +
            "`, `" + after + "`))");
    }
    static bool stops(Browser& browser) {
        return browser.becomes_true("document.getElementById('state').textContent === 'stopped at an error'");
    }
    std::string script() const { return text_of("plant_session.lua"); }
};

// The controls that a user can reach.

TEST_F(workbench_page_parts, the_bar_stays_however_long_the_script_is) {
    Browser browser(1366, 650);
    const auto program = open(browser);
    press_all(browser,
              {"New model", "New model", "New model", "+ report", "+ report", "+ report", "+ report", "+ report"});
    browser.evaluate("document.querySelector('#script').scrollIntoView(false)");
    EXPECT_EQ(browser.evaluate("return document.body.scrollTop + document.scrollingElement.scrollTop"), "0");
    EXPECT_EQ(browser.evaluate("return document.getElementById('bench-bar').getBoundingClientRect().top"), "0");
    for (const char* part : {"steps", "views", "script"})
        EXPECT_EQ(browser.evaluate("return document.getElementById('" + std::string(part) +
                                   "').getBoundingClientRect().bottom"),
                  browser.evaluate("return innerHeight"))
            << part;
}

TEST_F(workbench_page_parts, a_phone_scrolls_the_page_and_has_all_of_the_bar) {
    Browser browser(360, 640);
    const auto program = open(browser);
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('#bench-bar *')].filter((one) => "
                               "one.getBoundingClientRect().right > innerWidth).map((one) => one.id)"),
              "[]");
    browser.act(R"([{"type": "wheel", "id": "w", "actions": [{"type": "scroll", "x": 100, "y": 300, "deltaX": 0,
                    "deltaY": 700, "duration": 0}]}])");
    EXPECT_TRUE(browser.becomes_true("document.scrollingElement.scrollTop > 600", 5));
}

TEST_F(workbench_page_parts, titles_and_the_table_of_models_are_whole) {
    Browser browser(1280, 900);
    const auto program = open(browser);
    press_all(browser, {"Split 60 : 40", "New model", "New model"});
    const std::string cut =
        "return [...document.querySelectorAll('.tile h2')].filter((one) => one.scrollWidth > "
        "one.clientWidth + 1).map((one) => one.textContent)";
    EXPECT_EQ(browser.evaluate(cut), "[]");
    EXPECT_EQ(browser.evaluate("const table = document.querySelector('.models table'); return table.scrollWidth - "
                               "table.clientWidth"),
              "0");
    browser.evaluate(
        "const list = document.getElementById('language'); list.value = 'fr'; list.dispatchEvent(new "
        "Event('change'))");
    ASSERT_TRUE(
        browser.becomes_true("document.querySelector('.tile[data-view=residuals] h2').textContent === 'Résidus de "
                             "simulation'"));
    EXPECT_EQ(browser.evaluate(cut), "[]");
    EXPECT_TRUE(script_has(browser, "-- language: fr"));
    EXPECT_TRUE(says(browser, "Données")) << "buttons of pictures, too";
    EXPECT_FALSE(
        browser.becomes_true("[...document.querySelectorAll('.plot, .plot *')].some((one) => "
                             "/Show or hide|Arrow keys/.test(one.ariaLabel ?? ''))",
                             0.1));
}

TEST_F(workbench_page_parts, buttons_of_views_show_what_is_shown_and_bring_it_into_sight) {
    Browser browser;
    const auto program = open(browser);
    const std::string state =
        "[...document.querySelectorAll('#steps button')].find((one) => one.textContent === "
        "'Impulse response').ariaPressed";
    EXPECT_EQ(browser.evaluate("return " + state), "\"false\"");
    ASSERT_TRUE(press(browser, "Impulse response"));
    EXPECT_EQ(browser.evaluate("return " + state), "\"true\"");
    EXPECT_TRUE(says(browser, "No model yet")) << "an empty picture says why";
    press_all(browser, {"New model", "Nyquist"});
    EXPECT_TRUE(
        browser.becomes_true("(() => { const box = document.querySelector('.tile[data-view=nyquist]')"
                             ".getBoundingClientRect(); return box.top >= 0 && box.top < innerHeight - 100; })()"));
}

// What a mistake leaves.

TEST_F(workbench_page_parts, a_misspelt_method_keeps_table_controls_and_pictures) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"Split 60 : 40", "New model"});
    ASSERT_TRUE(view_appears(browser, "bode"));
    const std::string fit = browser.evaluate("return document.querySelectorAll('.models td.number')[3].textContent");
    type(browser, "G1 = tfsrivc", "G1 = tfsirvc");
    ASSERT_TRUE(stops(browser));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.models tr.broken')"));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.models td.number')[3].textContent"), fit);
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('.tile.older')].map((one) => one.dataset.view)"),
              R"(["compare","residuals","step","bode"])")
        << "all that show the model, and the record not";
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('.tile[data-view=bode] .told').textContent.includes('before the "
                             "error')"));
    browser.evaluate(
        "const field = document.querySelector('.chosen input[type=text]'); field.value = "
        "'tfsrivc(estimation, 1, 0)'; field.dispatchEvent(new Event('change'))");
    EXPECT_TRUE(
        browser.becomes_true("document.getElementById('state').textContent === 'up to date' && "
                             "!document.querySelector('.tile.older, .models tr.broken')"));
    EXPECT_THAT(script(), HasSubstr("G1 = tfsrivc(estimation, 1, 0)\n"));
}

TEST_F(workbench_page_parts, a_step_of_preparation_that_fails_keeps_the_parts_and_all_pictures) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"Split 60 : 40", "+ Level", "New model"});
    ASSERT_TRUE(view_appears(browser, "bode"));
    type(browser, "\"mean\"", "\"meen\"");
    ASSERT_TRUE(stops(browser));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('.tile.older canvas').length >= 4"));
    EXPECT_TRUE(browser.becomes_true("document.body.innerText.includes('Split 60 : 40')"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.models td.number')"));
    browser.evaluate(
        "const list = document.querySelector('.preparing select'); list.value = '\"linear\"'; "
        "list.dispatchEvent(new Event('change'))");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.tile.older')"));
}

TEST_F(workbench_page_parts, a_bracket_that_is_open_is_marked_where_it_was_opened) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"New model"});
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 2, 0)"));
    type(browser, "G1 = tfsrivc(estimation, 2, 0)", "G1 = tfsrivc((estimation, 2, 0");
    ASSERT_TRUE(stops(browser));
    EXPECT_TRUE(
        browser.becomes_true("[...document.querySelectorAll('.CodeMirror .broken-line')].map((one) => "
                             "one.textContent).join().includes('G1 = tfsrivc((')"));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('.models tbody tr').length === 1"));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('.chosen input[type=number]').length >= 2"))
        << "the controls of what it was";
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    EXPECT_TRUE(says(browser, "A report cannot be created from a script with an error")) << browser.evaluate(
        "return document.getElementById('trouble').textContent + document.getElementById('state').textContent");
}

TEST_F(workbench_page_parts, a_field_with_an_open_bracket_stays_and_writes_nothing) {
    const auto program = app("");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(says(browser, "Open data on the left")) << "an empty session says what to do";
    EXPECT_EQ(browser.evaluate("return document.getElementById('make-pdf').disabled"), "true");
    browser.evaluate("document.querySelectorAll('#steps details').forEach((one) => { one.open = true; })");
    ASSERT_TRUE(press(browser, "Start study"));
    ASSERT_TRUE(view_appears(browser, "study"));
    ASSERT_TRUE(is_ready(browser));
    const std::string before = text_of("session.lua"),
                      field =
                          "[...document.querySelectorAll('#steps label')].find((one) => "
                          "one.textContent.startsWith('system')).querySelector('input')";
    browser.evaluate("const field = " + field +
                     "; field.value = '2/(s^2 + '; field.dispatchEvent(new Event('change'))");
    EXPECT_TRUE(says(browser, "not closed: ("));
    EXPECT_EQ(text_of("session.lua"), before);
    EXPECT_EQ(browser.evaluate("return " + field + ".value"), "\"2/(s^2 + \"");
    browser.evaluate("const field = " + field + "; field.value = '2/'; field.dispatchEvent(new Event('change'))");
    ASSERT_TRUE(stops(browser));
    EXPECT_EQ(browser.evaluate("return " + field + ".value"), "\"2/\"") << "to be finished";
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.tile[data-view=study].older canvas')"));
    browser.evaluate("const field = " + field +
                     "; field.value = '3/(s + 1)'; field.dispatchEvent(new Event('change'))");
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.tile.older')"));
    std::string expected = before;
    expected.replace(expected.find("2/(s^2 + 4*s + 3)"), 17, "3/(s + 1)");
    EXPECT_EQ(text_of("session.lua"), expected);
}

// What follows from an edit.

TEST_F(workbench_page_parts, a_model_that_is_deleted_leaves_nothing_that_names_it) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"New model", "New model"});
    const auto report = [&](const std::string& view) {
        browser.evaluate("document.querySelector('.tile[data-view=" + view + "] .into').click()");
        ASSERT_TRUE(script_has(browser, "id=" + view));
        ASSERT_TRUE(is_ready(browser));
    };
    report("bode");
    report("residuals");
    EXPECT_THAT(script(), HasSubstr("bode(G1, G2, {labels = {\"G1\", \"G2\"}})"));
    EXPECT_THAT(script(), HasSubstr("(resid(validation, G2))"));
    ASSERT_TRUE(press(browser, "Report (PDF)"));  // there is text already: nothing more is written
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "const remove = document.querySelector('.actions button:last-child'); remove.focus(); remove.click()");
    ASSERT_TRUE(script_has(browser, "bode(G1), "));
    EXPECT_THAT(script(), Not(HasSubstr("G2")));
    EXPECT_THAT(script(), Not(HasSubstr("residuals"))) << "nor the text that showed it";
    EXPECT_TRUE(browser.becomes_true("document.activeElement.closest('.models')")) << "focus stays near";
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
    type(browser, "G1 = tfsrivc(estimation, 2, 0)", "G1 = tfsrivc(estimation, 2, 0)\nG3 = tfsrivc(estimation, G1)");
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.models tbody tr').length === 2"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "[...document.querySelectorAll('.models td button')].find((one) => one.textContent === 'G1').click()");
    const std::string before = script();
    ASSERT_TRUE(press(browser, "Delete"));
    EXPECT_TRUE(says(browser, "G3 = tfsrivc(estimation, G1)")) << "the line that would break";
    EXPECT_EQ(script(), before);
}

TEST_F(workbench_page_parts, a_cell_of_the_map_becomes_the_model_whose_controls_are_shown) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"New model", "Search orders"});
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('button.order').length >= 9"));
    browser.evaluate("document.querySelector('.models td button').click()");  // a click chose G1
    browser.evaluate("document.querySelectorAll('button.order')[4].click()");
    ASSERT_TRUE(script_has(browser, "G2 = tfsrivc"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.chosen h3').textContent === 'G2'"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.models tr.chosen button').textContent === 'G2'"));
}

TEST_F(workbench_page_parts, parts_keep_their_place_in_time_when_the_record_is_resampled_or_shortened) {
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"Split 60 : 40", "+ Resample"});
    ASSERT_TRUE(script_has(browser, "resample(prepared, 1, 2)"));
    EXPECT_THAT(script(), HasSubstr("estimation = prepared:range(1, 240)\nvalidation = prepared:range(241, 400)\n"));
    browser.evaluate("document.querySelector('.preparing input[type=checkbox]').click()");
    ASSERT_TRUE(script_has(browser, "prepared:range(481, 800)"));
    ASSERT_TRUE(is_ready(browser));
    press_all(browser, {"+ Range"});
    ASSERT_TRUE(script_has(browser, "prepared = prepared:range(1, 800)"));
    EXPECT_TRUE(
        browser.becomes_true("[...document.querySelectorAll('.preparing code')].map((one) => one.textContent).join() "
                             "=== 'resample,range'"));
    browser.evaluate(
        "const box = document.querySelectorAll('.preparing li:last-child input[type=number]')[0]; box.value "
        "= 101; box.dispatchEvent(new Event('change'))");
    ASSERT_TRUE(script_has(browser, "prepared:range(101, 800)"));
    EXPECT_THAT(script(), HasSubstr("estimation = prepared:range(1, 380)\nvalidation = prepared:range(381, 700)\n"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
}

TEST_F(workbench_page_parts, a_second_record_is_prepared_alike_and_shown) {
    write_data_set("second.csv");
    Browser browser;
    const auto program = open(browser);
    press_all(browser, {"+ Level"});
    browser.evaluate(
        "const list = document.querySelector('#steps select'); list.value = 'second.csv'; "
        "list.dispatchEvent(new Event('change'))");
    ASSERT_TRUE(press(browser, "Use for validation only"));
    ASSERT_TRUE(script_has(browser, "validation = second1\nvalidation = detrend(validation, \"mean\")\n"));
    EXPECT_TRUE(view_appears(browser, "second"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_FALSE(browser.becomes_true("document.body.innerText.includes('evaluated on its estimation data')", 0.2));
    EXPECT_EQ(browser.evaluate("return document.querySelector('.brush.validation').hidden"), "true")
        << "no part of the first record";
    press_all(browser, {"+ Resample"});
    ASSERT_TRUE(script_has(browser, "validation = resample(validation, 1, 2)\n"));
    ASSERT_TRUE(is_ready(browser));
    press_all(browser, {"Split 60 : 40 (without second1)"});
    EXPECT_THAT(script(), Not(HasSubstr("second")));
    EXPECT_THAT(script(), HasSubstr("validation = prepared:range(241, 400)\n"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
}

}  // namespace test_workbench_page
