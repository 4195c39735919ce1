// From the page to the submission: open items, points, the report and the ZIP file. Oracle: the files in the folder
// afterwards, and the questions and points that the test wrote.
#include <gmock/gmock.h>

#include "platform/atomic_file.h"
#include "support/preview.h"

namespace test_preview_submission {
using namespace dynlab;
using namespace dynlab::test;
namespace fs = std::filesystem;

class preview_submission : public preview_page {
  protected:
    /// A folder as a lesson's copy has it: two questions, one with two blanks, and the lesson's checks.
    void make_folder() const {
        fs::create_directory(folder.path() / "mine");
        write(
            "-- ---\n-- title: A report\n-- template: lesson\n-- answers:\n--   gain: number\n-- ---\n\n"
            "-- %% [markdown]\n-- **Question 1.** Which gain? `gain` is a number.\n\n"
            "-- %% id=asked\n-- YOUR CODE HERE\n\n-- %% id=hidden echo=false\n-- Not printed.\n\n"
            "-- %% [markdown]\n-- *Your answer:*\n--\n-- **Question 2.** Why?\n--\n-- *Your answer:*\n",
            "mine/analysis.lua");
        write("---\ntitle: A report\n---\n\n::: cells\n:::\n", "mine/report.md");
        write(
            "check {\n  id = \"gain\", points = 3, about = \"the gain\", hint = \"It is two.\",\n"
            "  test = function(a) return near(a.gain, 2) end }\n",
            "mine/checks.lua");
    }
    fs::path mine() const { return folder.path() / "mine"; }
};

const std::string kMade = "document.getElementById('made')";

TEST_F(preview_submission, report_and_zip_are_made_on_the_page) {
    make_folder();
    const Preview preview(mine());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Which gain?"));
    browser.click("#show-hand-in");
    browser.click("#make-report");
    EXPECT_TRUE(browser.becomes_true(kMade + ".innerText.includes('mine/report.pdf')", 60));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('make-report').disabled"));
    ASSERT_TRUE(fs::exists(mine() / "report.pdf"));
    EXPECT_EQ(read_file(mine() / "report.pdf").substr(0, 5), "%PDF-");
    browser.click("#make-pack");
    EXPECT_TRUE(browser.becomes_true(kMade + ".innerText.includes('mine.zip')", 60));
    EXPECT_THAT(browser.evaluate("return " + kMade + ".innerText"), testing::HasSubstr("report.pdf"));
    EXPECT_EQ(read_file(folder.path() / "mine.zip").substr(0, 2), "PK");
}

TEST_F(preview_submission, what_goes_wrong_is_reported) {
    make_folder();
    const Preview preview(mine(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Which gain?"));
    ASSERT_TRUE(
        browser.becomes_true("document.querySelector('.CodeMirror')?.CodeMirror.getValue().includes('Which gain?')"));
    browser.evaluate(
        "const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue() + "
        "'\\n-- %%\\nprint(nothing)\\n')");
    browser.click("#show-hand-in");
    browser.click("#make-report");  // saves first
    EXPECT_TRUE(browser.becomes_true(
        kMade + ".classList.contains('broken') && " + kMade + ".innerText.includes('nothing')", 60));
    EXPECT_THAT(read_text(mine() / "analysis.lua"), testing::HasSubstr("print(nothing)"));
}

TEST_F(preview_submission, nothing_is_made_of_what_was_not_allowed_to_run) {
    make_folder();
    const Preview preview(mine(), false);
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Which gain?"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('show-hand-in').hidden"), "true");
    for (const char* what : {"report", "pack"}) {
        browser.evaluate(
            std::string("window.refused = 0; fetch('") + what +
            "', {method: 'POST', headers: {'X-Dynlab': '1'}}).then(reply => { window.refused = reply.status })");
        EXPECT_TRUE(browser.becomes_true("window.refused === 403"));
    }
    EXPECT_FALSE(fs::exists(mine() / "report.pdf"));
    EXPECT_FALSE(fs::exists(folder.path() / "mine.zip"));
}

/// The points are those of the checks as they are now.
TEST_F(preview_submission, the_checks_are_followed) {
    make_folder();
    std::string script = read_text(mine() / "analysis.lua");
    script.replace(script.find("-- YOUR CODE HERE"), 17, "answer(\"gain\", 2)");
    write(script, "mine/analysis.lua");
    const Preview preview(mine());
    Browser browser;
    browser.open(preview.address());
    const std::string reported = "document.getElementById('show-findings').innerText";
    EXPECT_TRUE(browser.becomes_true("/3 of 3 points/.test(" + reported + ")", 120))
        << browser.evaluate("return " + reported);
    std::string checks = read_text(mine() / "checks.lua");
    checks.replace(checks.find("points = 3"), 10, "points = 5");
    checks.replace(checks.find("a.gain, 2"), 9, "a.gain, 4");
    write(checks, "mine/checks.lua");
    EXPECT_TRUE(browser.becomes_true("/0 of 5 points/.test(" + reported + ")", 120))
        << browser.evaluate("return " + reported);
}

/// A question with two blanks counts once. A missing answer is listed once.
TEST_F(preview_submission, each_thing_is_counted_once_and_points_are_shown) {
    make_folder();
    const Preview preview(mine());
    Browser browser;
    browser.open(preview.address());
    const std::string reported = "document.getElementById('show-findings').innerText";
    EXPECT_TRUE(browser.becomes_true("/1 answer missing, 2 rules violated.*0 of 3 points/.test(" + reported + ")", 120))
        << browser.evaluate("return " + reported);
    browser.click("#show-findings");
    const std::string panel = browser.evaluate("return document.getElementById('findings').innerText");
    EXPECT_THAT(panel, testing::HasSubstr("Question 1 is unanswered"));
    EXPECT_THAT(panel, testing::HasSubstr("Question 2 is unanswered"));
    EXPECT_THAT(panel, testing::HasSubstr("Checks of the lesson: 0 of 3 points"));
    // Each place is a button: to the question's line, and to where the answer is asked for.
    browser.evaluate("[...document.querySelectorAll('#findings button')].find(b => b.innerText === 'gain').click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.chosen')?.innerText.includes('Which gain?')"));
    browser.evaluate(
        "[...document.querySelectorAll('#findings button')].find(b => "
        "/analysis.lua:1[0-9]/.test(b.innerText)).click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.chosen')?.dataset.cell === 'asked'"));
}

/// Nothing is cut off or out of reach where the window is narrow, with everything that the bar can hold.
TEST_F(preview_submission, all_buttons_are_within_narrow_windows) {
    make_folder();
    write(read_text(mine() / "analysis.lua") + "\n-- %% id=wrong\nprint(nothing)\n", "mine/analysis.lua");
    const Preview preview(mine(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.editing .CodeMirror')"));
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('to-mistake').hidden"));
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('show-findings').hidden", 120));
    for (const char* width : {"1280", "800", "360"}) {
        browser.devtools(
            "Emulation.setDeviceMetricsOverride",
            std::string(R"({"height": 740, "deviceScaleFactor": 1, "mobile": false, "width": )") + width + "}");
        EXPECT_TRUE(browser.becomes_true(std::string("innerWidth === ") + width)) << width;
        EXPECT_EQ(browser.evaluate("return document.documentElement.scrollWidth <= innerWidth"), "true") << width;
        EXPECT_EQ(
            browser.evaluate("return [...document.querySelectorAll('#bar button, #editor-bar button')].filter(node => "
                             "node.offsetWidth > 0 && node.getBoundingClientRect().right > innerWidth).map(node => "
                             "node.id)"),
            "[]")
            << width;
        EXPECT_EQ(
            browser.evaluate("return [...document.querySelectorAll('button, input, select, textarea')].filter(node => "
                             "node.offsetWidth > 0 && !(node.innerText || node.ariaLabel || node.labels?.length || "
                             "node.closest('.CodeMirror'))).map(node => node.outerHTML)"),
            "[]")
            << width;
    }
}

TEST_F(preview_submission, code_that_is_not_printed_can_be_reached_beside_the_editor) {
    make_folder();
    const Preview preview(mine(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.editing .CodeMirror')"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.unseen')?.offsetHeight > 0"));
    EXPECT_EQ(
        browser.evaluate("return [...document.querySelectorAll('.piece')].map(n => n.dataset.cell).filter(c => c)"),
        "[\"asked\",\"hidden\"]");
    browser.click(".unseen button");
    EXPECT_TRUE(
        browser.becomes_true("(m => m.getLine(m.getCursor().line).includes('Not printed'))("
                             "document.querySelector('.CodeMirror').CodeMirror)"));
}

}  // namespace test_preview_submission
