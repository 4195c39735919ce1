// What the page of `dynlab preview` follows: scripts, data, templates, pictures, literature, and a run on its way.
// Oracle: what the files say that the test writes.
#include <gtest/gtest.h>

#include "support/preview.h"

namespace test_preview_following {
using namespace dynlab;
using namespace dynlab::test;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

using preview_following = preview_page;

TEST_F(preview_following, follows_files_that_editors_replace_and_that_come_back) {
    write(kHead + kFirst);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    std::string changed = kHead + kFirst;
    changed.replace(changed.find("x = 20"), 6, "x = 33");
    write(changed, ".analysis.lua.new");
    fs::rename(file(".analysis.lua.new"), file());
    EXPECT_TRUE(shows(browser, "x is 33"));
    fs::remove(file());
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('complaints').hidden"));
    EXPECT_TRUE(shows(browser, "x is 33"));
    write(kHead + kFirst);
    EXPECT_TRUE(shows(browser, "x is 20"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('complaints').hidden"));
}

TEST_F(preview_following, follows_data_and_template_of_a_report) {
    write("t,u,y\n0,1,5\n1,1,6\n", "d.csv");
    write(kHead + "-- %% id=data\nlocal d = load(\"d.csv\")\nreport.value(\"first\", d.y[1], \"%g\")\n");
    write("---\ntitle: My report\n---\n\nIt begins at `first`{.value}.\n", "report.md");
    const Preview preview(folder.path());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "It begins at 5."));
    write("t,u,y\n0,1,7\n1,1,6\n", "d.csv");
    EXPECT_TRUE(shows(browser, "It begins at 7."));
    write("---\ntitle: My report\n---\n\nThe first is `first`{.value}.\n", "report.md");
    EXPECT_TRUE(shows(browser, "The first is 7."));
}

// Field case 09: data that are gone, come back, come later, or were half written.
TEST_F(preview_following, follows_data_that_come_later_or_come_back) {
    const auto data = [&](const std::string& numbers, const std::string& name) { write("t,y\n" + numbers, name); };
    data("0,1\n1,2\n", "rec.csv");
    write(kHead +
          "-- %% id=data\nlocal d = load(\"rec.csv\")\nreport.value(\"m\", mean(d.y), \"%.3f\")\n\n"
          "-- %% [markdown]\n-- The mean is `m`{.value}.\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "The mean is 1.500."));
    fs::remove(file("rec.csv"));
    ASSERT_TRUE(state_is(browser, "data", "failed"));
    data("0,5\n1,6\n", "rec.csv");
    EXPECT_TRUE(shows(browser, "The mean is 5.500."));
    write("no numbers \"", "rec.csv");
    ASSERT_TRUE(state_is(browser, "data", "failed"));
    data("0,7\n1,8\n", "rec.csv.part");
    fs::rename(file("rec.csv.part"), file("rec.csv"));
    EXPECT_TRUE(shows(browser, "The mean is 7.500."));
    // In a folder that is not there yet.
    write(kHead +
          "-- %% id=data\nlocal d = load(\"records/a.csv\")\nreport.value(\"m\", mean(d.y), \"%.3f\")\n\n"
          "-- %% [markdown]\n-- The mean is `m`{.value}.\n");
    ASSERT_TRUE(state_is(browser, "data", "failed"));
    fs::create_directory(file("records"));
    data("0,9\n1,9\n", "records/a.csv");
    EXPECT_TRUE(shows(browser, "The mean is 9.000."));
    fs::remove_all(file("records"));
    ASSERT_TRUE(state_is(browser, "data", "failed"));
    fs::create_directory(file("records"));
    data("0,3\n1,3\n", "records/a.csv");
    EXPECT_TRUE(shows(browser, "The mean is 3.000."));
}

TEST_F(preview_following, follows_pictures_that_come_later) {
    write("-- ---\n-- title: A document\n-- ---\n\n-- %% [markdown]\n-- Words.\n--\n-- ![The rig](rig.svg)\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('complaints').hidden"));
    write("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"120\" height=\"40\"></svg>", "rig.svg");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('figure img')?.naturalWidth === 120"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('complaints').hidden"));
}

TEST_F(preview_following, follows_pictures_and_literature) {
    const auto draw = [&](const std::string& width) {
        write("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"40\"></svg>", "rig.svg");
    };
    const auto cite = [&](const std::string& title) {
        write("@book{ljung, author = {Ljung, Lennart}, title = {" + title + "}, year = {1999}}\n", "references.bib");
    };
    draw("200");
    cite("Systems");
    write(
        "-- ---\n-- title: A document\n-- bibliography: references.bib\n-- ---\n\n-- %% [markdown]\n"
        "-- After [@ljung].\n--\n-- ![The rig](rig.svg)\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('figure img')?.naturalWidth === 200"));
    EXPECT_TRUE(browser.becomes_true("document.body.innerText.includes('Systems')"));
    draw("100");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('figure img')?.naturalWidth === 100"));
    cite("Circuits");
    EXPECT_TRUE(browser.becomes_true("document.body.innerText.includes('Circuits')"));
}

/// The page reports an unreadable picture and keeps working.
TEST_F(preview_following, a_picture_that_cannot_be_read_does_not_end_the_page) {
    fs::create_symlink("/proc/self/mem", file("rig.png"));  // reading fails for every user
    const std::string text = "-- ---\n-- title: A document\n-- ---\n\n-- %% [markdown]\n-- ![The rig](rig.png)\n--\n";
    write(text + "-- Before.\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Before."));
    write(text + "-- After.\n");
    EXPECT_TRUE(shows(browser, "After."));
}

/// While a run is on its way, what it has not given yet is no mistake of the text.
TEST_F(preview_following, what_a_run_still_gives_is_not_complained_of) {
    const std::string slow = "local s = 0 for i = 1, 2e7 do s = s + i end\n";
    write(kHead);
    const Preview preview(file());
    Browser browser;
    browser.devtools(
        "Page.addScriptToEvaluateOnNewDocument",
        R"({"source": "window.ever = ''; window.half = false; new MutationObserver(() => { window.ever += )"
        R"(document.getElementById('complaints')?.textContent ?? ''; window.half ||= !!document.querySelector( )"
        R"('[data-cell=second][data-state=running]') && !!document.querySelector('figure .plot') && )"
        R"(!document.querySelector('td'); }).observe(document, {childList: true, attributes: true, subtree: true});"})");
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
    write(kHead + "-- %% id=first\nreport.figure(\"both\", plot({1, 2}, {1, 4}), \"A figure\")\n" + slow +
          "\n-- %% id=second\n" + slow + "report.table(\"both\", {{\"a\"}, {\"1.5\"}})\n\n-- %% [markdown]\n" +
          "-- ![A figure](figure:both){#fig:both}\n--\n-- ::: {.table name=both #tbl:both}\n-- A table.\n-- :::\n--\n"
          "-- See @fig:both and @tbl:both.\n");
    ASSERT_TRUE(browser.becomes_true("document.querySelector('td')?.innerText === '1.5'"));
    EXPECT_EQ(browser.evaluate("return window.half"), "true");
    EXPECT_EQ(browser.evaluate("return window.ever"), "\"\"");
}

/// A run of an older text does not delay the newer run, and the user does not need to stop it.
TEST_F(preview_following, a_run_of_an_older_text_is_given_up) {
    write(kHead + "-- %% id=loop\nwhile true do end\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(state_is(browser, "loop", "running"));
    write(kHead + "-- %% id=loop\nprint(\"over\")\n");
    EXPECT_TRUE(shows(browser, "over"));
    EXPECT_TRUE(state_is(browser, "loop", "done"));
}

TEST_F(preview_following, a_long_call_shows_how_far_it_is) {
    write(kHead);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
    write(kHead +
          "-- %% id=study\nlocal M = montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(4, 100), Ts = 0.01, sigma = "
          "0.2, "
          "runs = 400000, estimators = {{\"lssvf\", {2, 1, 0}, 3}}}\n");
    const std::string share = "Number(document.querySelector('[data-cell=study]')?.style.getPropertyValue('--done'))";
    ASSERT_TRUE(browser.becomes_true("document.querySelector('[data-state=running]') && " + share + " > 0.001 && " +
                                     share + " < 1"));
    const double early = std::stod(browser.evaluate("return " + share));
    EXPECT_TRUE(browser.becomes_true("/study, [0-9]+ %/.test(document.getElementById('state').innerText)"));
    EXPECT_TRUE(browser.becomes_true(share + " > " + std::to_string(early)));
    browser.click("#stop");
}

TEST_F(preview_following, the_last_of_many_saves_is_shown) {
    write(kHead + kFirst);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    for (int i = 0; i < 1000; ++i) {
        write(kHead + "-- %% [markdown]\n-- Save number " + std::to_string(i) +
              ".\n\n-- %% id=one\nlocal x = " + std::to_string(i) + "\nprint(\"x is \" .. x)\n");
        if (i % 10 == 0) std::this_thread::sleep_for(5ms);
    }
    EXPECT_TRUE(shows(browser, "Save number 999."));
    EXPECT_TRUE(shows(browser, "x is 999"));
}

}  // namespace test_preview_following
