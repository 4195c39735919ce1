// Data sets with several outputs on the workbench page. Oracles: the script on disk, its results when `dynlab run` runs
// it, and the positions in the window.
#include <gmock/gmock.h>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench_channels {
using namespace dynlab;
using namespace dynlab::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class workbench_channels : public workbench_page {
  protected:
    /// Clicks a control that a user can reach: a summary, a button, or an option of a list.
    static bool take(Browser& browser, const std::string& find, const std::string& act) {
        return browser.becomes_true("(() => { const found = " + find +
                                    "; if (!found || found.disabled || !found.offsetParent) return false; " + act +
                                    "; return true; })()");
    }
    static bool unfold(Browser& browser, const std::string& words) {
        return take(
            browser,
            "[...document.querySelectorAll('#steps summary')].find((one) => one.textContent === '" + words + "')",
            "found.click()");
    }
    static bool choose(Browser& browser, const std::string& list, const std::string& option) {
        return take(browser,
                    "[...document.querySelectorAll('#steps select')].find((one) => (one.ariaLabel ?? "
                    "one.closest('label').textContent).startsWith('" +
                        list + "'))",
                    "const at = [...found.options].findIndex((one) => one.textContent === '" + option +
                        "'); if (at < 0) return false; found.selectedIndex = at; found.dispatchEvent(new "
                        "Event('change', {bubbles: true}))");
    }
    /// Whether all of a view is inside the window, below the bar at the top.
    static bool is_in_sight(Browser& browser, const std::string& view) {
        return browser.becomes_true(
            "(() => { const box = document.querySelector('.tile[data-view=" + view +
                "] canvas')?.closest('.tile').getBoundingClientRect(); return box && box.top >= "
                "document.getElementById('bench-bar').getBoundingClientRect().bottom - 1 && box.bottom <= innerHeight "
                "+ 1; })()",
            10);
    }
    /// What the data say is there, which a busy machine computes for long.
    static bool rests(Browser& browser) {
        return browser.becomes_true("document.getElementById('state').textContent === 'up to date'", 120);
    }
    /// The page shows no internal error, and no view is empty.
    static void expect_no_dead_end(Browser& browser) {
        EXPECT_EQ(browser.evaluate("return document.getElementById('trouble').hidden"), "true");
        EXPECT_EQ(browser.evaluate("return document.body.innerText.includes('workbench:')"), "false");
        EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('.tile')].filter((one) => "
                                   "!one.querySelector('canvas, table')).map((one) => one.dataset.view)"),
                  "[]");
    }
    std::string run(const std::string& script) const {
        const Workbench shell;
        shell.write("run.lua", script);
        const ChildResult result = shell.dynlab({"run", "run.lua"});
        EXPECT_EQ(result.exit_code, 0) << result.error_output;
        return result.output;
    }
};

/// Tutorial 4.1: position and angle, validated on another experiment, from the file to the report in six clicks.
TEST_F(workbench_channels, the_crane_with_both_outputs_is_reported_with_validation_in_six_clicks) {
    const auto program = app("crane");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    ASSERT_TRUE(rests(browser));
    EXPECT_TRUE(says(browser, "u → theta, x"));
    ASSERT_TRUE(unfold(browser, "Open data"));
    ASSERT_TRUE(choose(browser, "course data", "crane"));
    ASSERT_TRUE(choose(browser, "Experiment", "validation"));
    ASSERT_TRUE(press(browser, "Use for validation only"));
    ASSERT_TRUE(script_has(browser, "validation = second1"));
    ASSERT_TRUE(rests(browser));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 3, 1, {TdMax = 0})")) << "the motor is a lag, no delay";
    for (const char* view : {"compare", "residuals", "step", "bode"}) ASSERT_TRUE(view_appears(browser, view)) << view;
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.models tbody tr').length === 2"));
    ASSERT_TRUE(rests(browser));
    expect_no_dead_end(browser);
    const std::string script = text_of("crane_session.lua");
    EXPECT_THAT(script, HasSubstr("second1 = iddata(matrix{second1_file.validation.theta, second1_file.validation.x}"));
    const std::string shown = browser.evaluate(
        "return import('./bench_session.js').then(({session}) => session.views.models.rows.map((row) => "
        "`${row.output_name} ${row.estimation.fit.toFixed(3)} ${row.validation.fit.toFixed(3)}`).join(', '))");
    const std::string computed =
        run(script +
            "local e, v = {fit(estimation, G1)}, {fit(validation, G1)}\n"
            "print(string.format(\"theta %.3f %.3f, x %.3f %.3f\", e[1], v[1], e[2], v[2]))\n");
    EXPECT_THAT(computed, HasSubstr(shown.substr(1, shown.size() - 2))) << "one fit for each output";
    EXPECT_EQ(browser.evaluate("return import('./bench_session.js').then(({session}) => ['compare', 'step', 'bode', "
                               "'residuals'].map((view) => session.views[view].figure.panels.length))"),
              "[2,2,4,4]");
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('make-pdf').disabled", 60));
    expect_no_dead_end(browser);
    EXPECT_THAT(text_of("crane_session.lua"), HasSubstr("report.figure(\"compare\", compare(validation, G1"));
}

TEST_F(workbench_channels, orders_are_searched_for_one_output_and_a_structure_changes_that_one) {
    const auto program = app("crane");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    ASSERT_TRUE(rests(browser));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc("));
    ASSERT_TRUE(choose(browser, "output to search", "x"));
    ASSERT_TRUE(press(browser, "Search orders"));
    ASSERT_TRUE(script_has(browser, "orders1 = srivcstruc(estimation:select(2), {"));
    ASSERT_TRUE(take(browser, "[...document.querySelectorAll('button.order')].at(-1)", "found.click()"));
    EXPECT_TRUE(script_has(browser, "G2 = tfsrivc(estimation, {3, 4}, {1, 2}, {TdMax = 0})"));
    ASSERT_TRUE(rests(browser));
    ASSERT_TRUE(
        take(browser, "document.querySelector('.tile[data-view=orders] button[aria-label^=Delete]')", "found.click()"));
    EXPECT_TRUE(
        browser.becomes_true("!document.querySelector('.CodeMirror').CodeMirror.getValue().includes('orders1')"));
    EXPECT_THAT(text_of("crane_session.lua"), AllOf(Not(HasSubstr("srivcstruc")), HasSubstr("G2 = ")));
}

const std::string kTwoOutputs =
    "-- %% id=record\nlocal u = prbs(7, 8)\nlocal y = lsim(tf({2}, {1, 4, 3}), u, 0.05)\nlocal z = lsim(tf({1}, {1, "
    "1}), u, 0.05)\nfor k = 1, #y do y[k], z[k] = y[k] + 0.01*randn(), z[k] + 0.01*randn() end\ndata = "
    "iddata(matrix{y, z}, u, 0.05, {OutputName = {\"near\", \"far\"}})\n\n";

/// A search for other channels is an error in the workbench's words, with a remedy beside it.
TEST_F(workbench_channels, a_search_left_over_from_other_channels_is_fixed_or_deleted_beside_its_error) {
    for (const bool fixes : {true, false}) {
        write("mine.lua", kTwoOutputs +
                              "-- %% id=orders1\norders1 = srivcstruc(data, {poles = {1, 2}, zeros = {0, "
                              "0}})\n\n-- %% id=G1\nG1 = tfsrivc(data, 2, 0, {TdMax = 0})\n");
        const auto program = app("mine.lua", {"--run"});
        Browser browser;
        browser.open(program->address());
        ASSERT_TRUE(says(browser, "orders1 compares structures of one output, but data has the outputs near, far."));
        ASSERT_TRUE(press(browser, fixes ? "Search for far" : "Delete: orders1"));
        EXPECT_TRUE(browser.becomes_true("document.getElementById('trouble').hidden"));
        EXPECT_TRUE(view_appears(browser, "compare")) << "the steps behind it are made";
        const std::string script = text_of("mine.lua");
        if (fixes)
            EXPECT_THAT(script, HasSubstr("srivcstruc(data:select(2), {poles"));
        else
            EXPECT_THAT(script, AllOf(Not(HasSubstr("orders1")), HasSubstr("\nG1 = tfsrivc(")));
    }
}

/// A model of one output appears with the models of all outputs. The page names a model that has no output of the data.
/// No view is empty.
TEST_F(workbench_channels, models_of_some_outputs_are_shown_where_they_belong) {
    write("mine.lua", kTwoOutputs +
                          "-- %% id=G1\nG1 = tfsrivc(data, 2, 0, {TdMax = 0})\n\n-- %% id=G2\nG2 = "
                          "tfsrivc(data:select(2), 1, 0, {TdMax = 0})\n\n-- %% id=H\nH = tf({1}, {1, 1})\n");
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(rests(browser));
    EXPECT_TRUE(says(browser, "Not shown: H."));
    const auto labels = [&](const std::string& view) {
        return browser.evaluate("return import('./bench_session.js').then(({session}) => session.views." + view +
                                ".figure.panels.map((panel) => panel.curves.map((one) => one.name).filter((text) => "
                                "/^[GH]/.test(text)).map((text) => text.slice(0, 2)).join('+')).join(' '))");
    };
    EXPECT_EQ(labels("compare"), "\"G1 G1+G2\"");
    EXPECT_EQ(labels("step"), "\"G1 G1+G2\"");
    EXPECT_EQ(browser.evaluate("return import('./bench_session.js').then(({session}) => session.views.models.rows.map("
                               "(row) => `${row.name} ${row.output_name ?? '-'}`).join())"),
              "\"G1 near,G1 far,G2 far,H -\"");
}

/// Three lags look like a delay to two poles; a real delay stays one.
TEST_F(workbench_channels, the_first_model_has_a_delay_only_where_no_lag_explains_the_response) {
    const auto proposal = [&](const std::string& name, const std::string& plant) {
        write(name + ".lua", "-- %% id=record\nlocal u = prbs(7, 10)\nlocal y = lsim(" + plant +
                                 ", u, 0.05)\nfor k = 1, #y do y[k] = y[k] + 0.005*randn() end\ndata = iddata(y, u, "
                                 "0.05)\n");
        const auto program = app(name + ".lua", {"--run"});
        Browser browser;
        browser.open(program->address());
        EXPECT_TRUE(view_appears(browser, "record"));
        EXPECT_TRUE(rests(browser));
        EXPECT_TRUE(press(browser, "New model"));
        EXPECT_TRUE(script_has(browser, "G1 = "));
        const std::string script = text_of(name + ".lua");
        return script.substr(script.find("G1 = "));
    };
    EXPECT_THAT(proposal("lags", "tf({5*4*15}, {1, 24, 143, 300})"), HasSubstr("tfsrivc(data, 3, 1, {TdMax = 0})"));
    EXPECT_THAT(proposal("late", "tf({2}, {1, 4, 3}, {IODelay = 0.43})"), HasSubstr("tfsrivc(data, 2, 0)"));
}

/// The window is 800 pixels high, and other content comes above the view.
TEST_F(workbench_channels, a_view_that_was_asked_for_is_in_sight) {
    write("step.lua",
          "-- %% id=record\nlocal u = step_signal(300, 30)\nlocal y = lsim(tf({2}, {3, 1}), u, 0.1)\ndata "
          "= iddata(y, u, 0.1)\n\n-- %% id=G1\nG1 = procsrivc(data, \"P1\")\n");
    const auto program = app("step.lua", {"--run"});
    Browser browser(1280, 800);
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "bode"));
    ASSERT_TRUE(rests(browser));
    ASSERT_TRUE(unfold(browser, "Read by hand"));
    ASSERT_TRUE(press(browser, "First order"));
    EXPECT_TRUE(is_in_sight(browser, "reading"));
    EXPECT_TRUE(browser.becomes_true(
        "/63 % of its change after T = [\\d.]+ s and /.test(document.querySelector('.tile[data-view=reading] "
        ".told').textContent)"));
    for (const auto& [words, view] : {std::pair("Spectrum", "spectrum"), std::pair("Nyquist", "nyquist")}) {
        ASSERT_TRUE(press(browser, words));
        EXPECT_TRUE(is_in_sight(browser, view)) << view;
    }
    for (const char* name : {"procsrivc", "bode", "idplot"}) {
        browser.evaluate(
            std::string("[...document.querySelectorAll('.why')].find((one) => one.title === 'dynlab help ") + name +
            "').click()");
        ASSERT_TRUE(browser.becomes_true("document.getElementById('page-of-help').open")) << name;
        EXPECT_TRUE(
            browser.becomes_true("(() => { const box = document.getElementById('close-help').getBoundingClientRect(); "
                                 "return box.top > 0 && box.bottom < innerHeight; })()"));
        EXPECT_TRUE(
            browser.becomes_true("document.querySelector('#help-text > p') && document.querySelector('#help-text > "
                                 "details:not([open])')"));
        browser.click("#close-help");
    }
}

/// A sine of 2 rad/s has its power there.
TEST_F(workbench_channels, the_spectrum_goes_into_the_report) {
    write("sine.lua",
          "-- %% id=record\nlocal t = range(0, 999)*(2*math.pi/100)\nlocal y = sin(2*t) + 0.01*randn(1000)\n"
          "data = iddata(matrix{y, 2*y}, sin(2*t), 2*math.pi/100)\n");
    const auto program = app("sine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "spectrum"));
    ASSERT_TRUE(rests(browser));
    browser.click(".tile[data-view=spectrum] .into");
    ASSERT_TRUE(script_has(browser, "report.figure(\"spectrum\""));
    ASSERT_TRUE(rests(browser));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('trouble').hidden"));
    std::string script = text_of("sine.lua");
    script.replace(script.find("report.figure(\"spectrum\", "), std::string("report.figure(\"spectrum\", ").size(),
                   "F = (function(f) return f end)(");
    const std::string reported =
        run(script +
            "-- %% id=peaks\nfor _, one in ipairs(F.curves) do local best = 1 for k = 1, #one.y do if one.y[k] > "
            "one.y[best] then best = k end "
            "end print(string.format(\"peak at %.2f\", one.x[best])) end\n");
    EXPECT_THAT(reported, HasSubstr("peak at 2.00\npeak at 2.00"));
}

}  // namespace test_workbench_channels
