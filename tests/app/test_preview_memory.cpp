// Pages that are whole at once when a document is opened again. Oracle: the page as it was the first time, and the
// files that the test writes.
#include <gtest/gtest.h>

#include "support/preview.h"

namespace test_preview_memory {
using namespace dynlab;
using namespace dynlab::test;
namespace fs = std::filesystem;

using preview_memory = preview_page;

/// All that a page ever showed is kept in it.
void keep_what_is_shown(Browser& browser) {
    browser.devtools("Page.addScriptToEvaluateOnNewDocument",
                     R"({"source": "window.ever = ''; new MutationObserver(() => { window.ever += )"
                     R"(document.body?.textContent; }).observe(document, {childList: true, subtree: true});"})");
}

/// A page that was whole is whole at once when the document is opened again, and is that of a run all the same.
TEST_F(preview_memory, is_whole_at_once_when_it_is_opened_again) {
    const std::string slow = kHead +
                             "-- %% id=slow\nlocal s = 0 for i = 1, 5e7 do s = s + 1 end\nprint(\"it is \" .. s)\n\n" +
                             kFirst + kPlot;
    write(slow);
    const fs::path cache = folder.path() / "cache";
    const std::string whole =
        "document.getElementById('document').innerText.includes('it is 5') && "
        "document.querySelector('figure .plot')";
    const std::string at_rest =
        "document.getElementById('stop').hidden && "
        "document.querySelectorAll('[data-state=done]').length > 2";
    const std::string pieces = "return [...document.querySelectorAll('.piece')].map(n => n.id + n.innerHTML).join()";
    std::string first;
    {
        const Preview preview(file(), true, {}, cache);
        Browser browser;
        browser.open(preview.address());
        ASSERT_TRUE(browser.becomes_true(whole + " && " + at_rest));
        first = browser.evaluate(pieces);
    }
    const Preview preview(file(), true, {}, cache);
    preview.hold();
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true(whole));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('[data-state=recalled]').length > 2"));
    EXPECT_EQ(browser.evaluate(pieces), first);
    EXPECT_TRUE(
        browser.becomes_true("document.getElementById('state').innerText.startsWith('results of the previous run')"));
    EXPECT_TRUE(
        browser.becomes_true("!document.getElementById('stop').hidden && document.getElementById('state').innerText "
                             "=== 'results of the previous "
                             "run; running again' && document.querySelectorAll('[data-state=recalled]').length > 2"));
    browser.evaluate("for (const node of document.querySelectorAll('.piece')) node.seen = true");
    preview.go_on();
    EXPECT_TRUE(browser.becomes_true(at_rest));
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('.piece')].filter(n => !n.seen).length"), "0");

    std::string changed = slow;
    changed.replace(changed.find("x = 20"), 6, "x = 21");
    write(changed);
    EXPECT_TRUE(shows(browser, "x is 21"));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('state').innerText.includes('before')"));
}

/// The cached page of the previous run does not hide a change made while that page was shown or while no page was open.
TEST_F(preview_memory, cached_pages_do_not_hide_changes) {
    const auto written = [&](const std::string& x) {
        write(kHead + "-- %% id=slow\nlocal s = 0 for i = 1, 5e7 do s = s + 1 end\nprint(\"it is \" .. s)\n\n" +
              "-- %% id=one\nlocal x = " + x + "\nprint(\"x is \" .. x)\n");
    };
    const fs::path cache = folder.path() / "cache";
    const std::string at_rest = "document.getElementById('stop').hidden";
    written("20");
    {
        const Preview preview(file(), true, {}, cache);
        Browser browser;
        browser.open(preview.address());
        ASSERT_TRUE(shows(browser, "x is 20"));
        ASSERT_TRUE(browser.becomes_true(at_rest));
    }
    {
        const Preview preview(file(), true, {}, cache);
        preview.hold();
        Browser browser;
        browser.open(preview.address());
        ASSERT_TRUE(
            browser.becomes_true("document.getElementById('state').innerText.includes('results of the previous run')"));
        written("21");
        preview.go_on();
        EXPECT_TRUE(shows(browser, "x is 21"));
        EXPECT_EQ(browser.evaluate("return document.getElementById('document').innerText.includes('x is 20')"),
                  "false");
        EXPECT_TRUE(browser.becomes_true(at_rest));
    }
    written("22");
    const Preview preview(file(), true, {}, cache);
    preview.hold();
    Browser browser;
    keep_what_is_shown(browser);
    browser.open(preview.address());
    preview.go_on();
    EXPECT_TRUE(shows(browser, "x is 22"));
    EXPECT_EQ(browser.evaluate("return /x is 2[01]/.test(window.ever)"), "false");
}

TEST_F(preview_memory, a_run_behind_a_cached_page_can_be_stopped) {
    write(kHead + kFirst + "-- %% id=slow\nlocal s = 0 for i = 1, 5e7 do s = s + 1 end\nprint(\"ov\" .. \"er\")\n");
    const fs::path cache = folder.path() / "cache";
    {
        const Preview preview(file(), true, {}, cache);
        Browser browser;
        browser.open(preview.address());
        ASSERT_TRUE(
            browser.becomes_true("document.getElementById('document').innerText.includes('over') && "
                                 "document.getElementById('stop').hidden",
                                 60));
    }
    const Preview preview(file(), true, {}, cache);
    preview.hold();
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('stop').hidden"));
    EXPECT_TRUE(shows(browser, "over"));
    browser.click("#stop");
    preview.go_on();
    EXPECT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('state').innerText"), "\"results of the previous run\"");
    EXPECT_TRUE(shows(browser, "over"));
}

TEST_F(preview_memory, cached_pages_are_not_shown_for_other_data) {
    write("a\n1\n2\n", "numbers.csv");
    write(kHead +
          "-- %% id=one\nprint(\"last \" .. load(\"numbers.csv\").a[2])\n\n"
          "-- %% id=slow\nlocal s = 0 for i = 1, 4e7 do s = s + 1 end\nprint(\"ov\" .. \"er\")\n");
    const fs::path cache = folder.path() / "cache";
    const auto open = [&](const std::string& shown, const std::string& not_shown) {
        const Preview preview(file(), true, {}, cache);
        Browser browser;
        keep_what_is_shown(browser);
        browser.open(preview.address());
        EXPECT_TRUE(shows(browser, shown));
        EXPECT_TRUE(shows(browser, "over"));
        EXPECT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
        EXPECT_EQ(browser.evaluate("return window.ever.includes('" + shown + "')"), "true");
        EXPECT_EQ(browser.evaluate("return window.ever.includes('" + not_shown + "')"), "false");
    };
    open("last 2", "last 5");
    write("a\n1\n5\n", "numbers.csv");
    open("last 5", "last 2");
}

}  // namespace test_preview_memory
