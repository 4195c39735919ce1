// What a session of the workbench leaves: its script goes through run, report, check and pack as it is, and its report
// shows what the page showed. Oracles: the programs' own words, the text of the PDF, and the same by hand.
#include <gmock/gmock.h>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench_reports {
using namespace dynlab;
using namespace dynlab::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class workbench_reports : public workbench_page {
  protected:
    ChildResult dynlab(const std::string& words) const {
        return shell.shell("cd " + folder.path().string() +
                           " && DYNLAB_HOME=" DYNLAB_SOURCE_DIR " " DYNLAB_PROGRAM " " + words);
    }
    /// Chooses in the list whose name for screen readers, or whose label, ends so.
    static void choose(Browser& browser, const std::string& list, const std::string& option) {
        ASSERT_TRUE(browser.becomes_true(
            "(() => { const list = [...document.querySelectorAll('#steps select')].find((one) => "
            "(one.ariaLabel ?? one.closest('label')?.textContent ?? '').trim().endsWith('" +
            list + "') || one.closest('label')?.textContent.trim().startsWith('" + list +
            "')); const wanted = list && [...list.options].find((one) => one.textContent === '" + option +
            "'); if (!wanted) return false; list.value = wanted.value; list.dispatchEvent(new "
            "Event('change', {bubbles: true})); return true; })()"))
            << list;
    }
    static void open_crane(Browser& browser) {
        browser.evaluate(
            "[...document.querySelectorAll('#steps summary')].filter((one) => one.textContent.startsWith('Open data') "
            "&& !one.parentNode.open).forEach((one) => one.click())");
        choose(browser, "course data sets, and files in this folder", "crane");
        ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('#steps .chip').length > 3"));
    }
    const Workbench shell;
};

/// The crane, identified from raw data by clicks: position (an integrator) and angle together, validated on another
/// experiment.
TEST_F(workbench_reports, the_crane_is_identified_by_clicks_with_both_outputs_and_reported) {
    const auto program = app("03_crane");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    open_crane(browser);
    choose(browser, ": estimation.x", "output");
    browser.evaluate(
        "for (const [name, unit] of [['theta', 'rad'], ['x', 'm']]) { const field = document.querySelector(`#steps "
        "input.unit[aria-label$='estimation.${name}']`); field.value = unit; field.dispatchEvent(new Event('input')); "
        "}");
    ASSERT_TRUE(press(browser, "Use these data"));
    ASSERT_TRUE(script_has(browser, "OutputName = {\"theta\", \"x\"}, OutputUnit = {\"rad\", \"m\"}"));
    ASSERT_TRUE(is_ready(browser));
    open_crane(browser);
    choose(browser, ": estimation.x", "output");
    choose(browser, "Experiment", "validation");
    ASSERT_TRUE(press(browser, "Use for validation only"));
    ASSERT_TRUE(script_has(browser, "validation = second1"));
    ASSERT_TRUE(is_ready(browser));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 3, 1, {TdMax = 0})"));
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(is_ready(browser));
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('make-pdf').disabled", 60));
    const ChildResult report = dynlab("report 03_crane_session.lua -o crane.pdf && pdftotext -layout crane.pdf -");
    EXPECT_EQ(report.exit_code, 0) << report.error_output;
    EXPECT_THAT(report.output, AllOf(HasSubstr("Figure 1."), HasSubstr("Table 1."), HasSubstr("x (m)"),
                                     HasSubstr("theta (rad)"), Not(HasSubstr("??"))));
}

/// The text that the workbench wrote follows the language of the script. Text that the user changed stays as it is.
TEST_F(workbench_reports, the_language_turns_what_the_workbench_has_written_and_says) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(is_ready(browser));
    for (const char* view : {"compare", "step"}) {
        browser.click(std::string(".tile[data-view=") + view + "] .into");
        ASSERT_TRUE(script_has(browser, std::string("@fig:") + view + " shows"));
        ASSERT_TRUE(is_ready(browser));
    }
    browser.evaluate(
        "const mirror = document.querySelector('.CodeMirror').CodeMirror; mirror.setValue(mirror.getValue().replace("
        "'the response to a unit step', 'how it settles'));");
    ASSERT_TRUE(is_ready(browser));
    const auto turn_to = [&](const std::string& language) {
        browser.evaluate("const list = document.getElementById('language'); list.value = '" + language +
                         "'; list.dispatchEvent(new Event('change'))");
        ASSERT_TRUE(script_has(browser, "-- language: " + language + "\n"));
        ASSERT_TRUE(is_ready(browser));
    };
    turn_to("en");
    const std::string english = text_of("plant_session.lua");
    EXPECT_THAT(english, AllOf(HasSubstr("@fig:step shows how it settles."), HasSubstr("title: Identification from ")));
    turn_to("fr");
    EXPECT_THAT(
        text_of("plant_session.lua"),
        AllOf(HasSubstr("-- title: Identification à partir de plant.csv\n"),
              HasSubstr("-- La @fig:compare montre les sorties mesurées et simulées.\n"),
              HasSubstr("\"Réponse indicielle, avec sa bande de confiance là où elle est connue\")\n"),
              HasSubstr("-- ![Réponse indicielle, avec sa bande de confiance là où elle est connue](figure:step)"),
              HasSubstr("-- @fig:step shows how it settles.\n"), Not(HasSubstr("Measured output"))));
    EXPECT_TRUE(
        browser.becomes_true("[...document.querySelectorAll('#steps option')].some((one) => "
                             "one.textContent.includes('chacune avec D, I et Z au choix'))"))
        << "what is said of the methods";
    turn_to("en");
    EXPECT_EQ(text_of("plant_session.lua"), english);
    EXPECT_TRUE(
        browser.becomes_true("[...document.querySelectorAll('#steps option')].some((one) => "
                             "one.textContent.includes('each optionally with D, I and Z'))"));
}

/// The messages of a run are in the language of its script. A page in another language would mix both.
TEST_F(workbench_reports, a_new_session_is_in_the_language_of_the_browser_and_another_in_its_own) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.devtools("Network.setUserAgentOverride", R"({"userAgent": "Chromium", "acceptLanguage": "fr-FR"})");
    browser.open(program->address());
    ASSERT_TRUE(script_has(browser, "-- language: fr\n"));
    EXPECT_TRUE(browser.becomes_true("document.documentElement.lang === 'fr'"));
    write("other.lua", "x = 1\n");
    const auto other = app("other.lua", {"--run"});
    browser.open(other->address());
    ASSERT_TRUE(script_has(browser, "x = 1\n"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_EQ(browser.evaluate("return document.documentElement.lang"), "\"en\"");
    EXPECT_EQ(text_of("other.lua"), "x = 1\n");
}

/// What the page's report holds is what each command makes of the script.
TEST_F(workbench_reports, a_session_goes_through_run_report_check_and_pack_as_it_is) {
    write("plant.csv", [] {
        std::string text = "time (s),u,y\n";
        double x = 0;
        for (int k = 0; k < 400; ++k) {
            const double u = (k / 13 + k / 29) % 2;
            text += std::to_string(0.1 * k) + "," + std::to_string(u) + "," + std::to_string(x) + "\n";
            x += 0.1 * (2 * u - x);
        }
        return text;
    }());
    {
        const auto program = app("plant.csv");
        Browser browser;
        browser.open(program->address());
        ASSERT_TRUE(press(browser, "Split 60 : 40"));
        ASSERT_TRUE(is_ready(browser));
        ASSERT_TRUE(press(browser, "New model"));
        ASSERT_TRUE(view_appears(browser, "compare"));
        ASSERT_TRUE(press(browser, "Report (PDF)"));
        ASSERT_TRUE(browser.becomes_true("!document.getElementById('make-pdf').disabled", 60));
        ASSERT_TRUE(script_has(browser, "report.figure(\"compare\""));
        ASSERT_TRUE(press(browser, "Undo"));  // the lines of the report are one step
        ASSERT_TRUE(browser.becomes_true(
            "!document.querySelector('.CodeMirror').CodeMirror.getValue().includes('report.figure')"));
        ASSERT_TRUE(press(browser, "Redo"));
        ASSERT_TRUE(script_has(browser, "report.figure(\"compare\""));
    }
    EXPECT_EQ(dynlab("run plant_session.lua").exit_code, 0);
    const ChildResult report = dynlab("report plant_session.lua");
    EXPECT_EQ(report.exit_code, 0) << report.error_output;
    EXPECT_THAT(report.output, HasSubstr("plant_session.pdf"));
    const ChildResult text = shell.shell("pdftotext -layout " + file("plant_session.pdf").string() + " -");
    EXPECT_THAT(text.output,
                AllOf(HasSubstr("Figure 1."), HasSubstr("Table 1."), HasSubstr("Parameters:"), Not(HasSubstr("??"))));
    const ChildResult checked = dynlab("check plant_session.lua");
    EXPECT_EQ(checked.exit_code, 0) << checked.output;
    EXPECT_THAT(checked.output, AllOf(HasSubstr("plant_session.lua"), Not(HasSubstr("analysis.lua"))));
    const ChildResult packed = dynlab("pack plant_session.lua");
    EXPECT_THAT(packed.output, AllOf(HasSubstr("analysis.lua"), HasSubstr("plant.csv"), HasSubstr("report.md"),
                                     HasSubstr("report.pdf")));
    EXPECT_TRUE(std::filesystem::exists(file("plant_session.zip")));
}

/// The page explains commonly confused results where they appear.
TEST_F(workbench_reports, traps_are_shown_and_not_forbidden) {
    write("traps.lua",
          "-- %% id=record\nu = prbs(7, 8)\ny = lsim(tf({2}, {1, 4, 3}, {IODelay = 0.3}), u, 0.05)\n"
          "data = iddata(y, u, 0.05)\nprepared = data:shift(3)\n\n"
          "-- %% id=G1\nG1 = arx(prepared, {2, 2, 1})\n");
    const auto program = app("traps.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    EXPECT_TRUE(says(browser, "prediction error"));
    EXPECT_FALSE(browser.becomes_true("document.body.innerText.includes('the sum of both')", 0.1));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "G2 = tfsrivc("));
    EXPECT_TRUE(says(browser, "shifted the input (shift in samples: 3)"));
    EXPECT_FALSE(
        browser.becomes_true("document.body.innerText.includes('minimizes the one-step prediction error')", 0.1));
}

TEST_F(workbench_reports, a_script_that_is_not_there_or_stops_is_reported) {
    EXPECT_THAT(dynlab("pack nothing.lua").error_output, HasSubstr("nothing.lua"));
    write("stops.lua", "-- ---\n-- title: It's \"mine\"\n-- ---\nlocal file = load('away.csv')\n");
    const ChildResult checked = dynlab("check stops.lua");
    EXPECT_EQ(checked.exit_code, 1);
    EXPECT_THAT(checked.output, AllOf(HasSubstr("stops.lua"), HasSubstr("away.csv")));
    EXPECT_EQ(dynlab("pack stops.lua").exit_code, 0);
}

}  // namespace test_workbench_reports
