// An HTML document in a real browser, from a file: contents, light and dark, paper, phones, code to copy. Oracle: what
// the document's text says, and what the browser computes of the page.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "documents/document.h"
#include "platform/temporary_folder.h"
#include "support/browser.h"

namespace test_web_pages {
using namespace dynlab;
using nlohmann::json;
using test::Browser;
namespace fs = std::filesystem;

const std::string kText =
    "---\ntitle: A page\n---\n\n# First part\n\nWords.\n\n```lua\nlocal x = 1\nprint(\"a long line of a script that no "
    "telephone shows whole\", x)\n```\n\n## Within $x^2$\n\nMore words.\n\n# Second part\n\n"
    "$$ y(t) = a_1 x(t) + a_2 x(t)^2 + a_3 x(t)^3 + a_4 x(t)^4 + a_5 x(t)^5 + a_6 x(t)^6 + e(t) $$\n\n"
    "| one column | another column | a third column | a fourth column | a fifth |\n|---|---|---|---|---|\n"
    "| 1.23456789 | 2.3456789 | 3.456789 | 4.56789 | 5 |\n\n"
    "Averyveryveryveryveryveryveryveryveryveryveryveryverylongwordwithoutanyspace.\n";

class web_pages : public testing::Test {
  protected:
    void open(const std::string& text = kText) {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        std::ofstream(folder.path() / "report.md") << text;
        DocumentSource source;
        source.template_file = folder.path() / "report.md";
        source.record = &record;
        DocumentMaker({.use_cache = false}).make(source, folder.path() / "page.html", DocumentFormat::kHtml, nullptr);
        browser.open("file://" + (folder.path() / "page.html").string());
        ASSERT_TRUE(browser.becomes_true("document.querySelector('.theme')"));
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    void media(const std::string& kind, const std::string& scheme) {
        const json features = json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}});
        browser.devtools("Emulation.setEmulatedMedia", json{{"media", kind}, {"features", features}}.dump());
    }
    void be_wide(int pixels) {
        browser.devtools(
            "Emulation.setDeviceMetricsOverride",
            json{{"width", pixels}, {"height", 800}, {"deviceScaleFactor", 1}, {"mobile", pixels < 500}}.dump());
    }
    bool is_dark() { return value("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"; }

    TemporaryFolder folder;
    RunRecord record;
    Browser browser;
};

TEST_F(web_pages, contents_lead_to_the_sections) {
    open();
    EXPECT_EQ(value("[...document.querySelectorAll('.contents a')].map(a => a.textContent.trim().split(/\\s/)[0])"),
              json({"First", "Within", "Second"}));
    EXPECT_EQ(value("[...document.querySelectorAll('.contents a')].every(a => "
                    "document.getElementById(a.hash.slice(1))?.tagName.startsWith('H'))"),
              true);
    EXPECT_EQ(value("document.querySelectorAll('.contents math').length"), 1);
    be_wide(1400);
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.contents').open"));
    EXPECT_EQ(value("document.querySelector('.contents').getBoundingClientRect().right < "
                    "document.querySelector('main').getBoundingClientRect().left"),
              true);
    be_wide(800);
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.contents').open"));
}

TEST_F(web_pages, short_ones_and_those_with_a_list_of_their_own_get_no_contents) {
    open("---\ntitle: A page\n---\n\n# One\n\nWords.\n");
    EXPECT_EQ(value("document.querySelectorAll('.contents').length"), 0);
    std::string with_list = kText;
    with_list.insert(4, "toc: true\n");
    open(with_list);
    EXPECT_EQ(value("document.querySelectorAll('.contents').length"), 0);
    EXPECT_EQ(value("document.querySelectorAll('main nav').length"), 1);
}

TEST_F(web_pages, are_dark_where_the_system_is_unless_set_otherwise_and_light_on_paper) {
    media("", "dark");
    open();
    EXPECT_TRUE(is_dark());
    media("print", "dark");
    EXPECT_FALSE(is_dark());
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.tools')).display"), "none");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.copy')).display"), "none");
    media("", "dark");
    browser.click(".theme");
    EXPECT_FALSE(is_dark());
    media("", "light");
    EXPECT_FALSE(is_dark());
    browser.click(".theme");
    EXPECT_TRUE(is_dark());
    media("print", "light");
    EXPECT_FALSE(is_dark());
    media("", "light");
    browser.open("file://" + (folder.path() / "page.html").string());
    EXPECT_TRUE(is_dark()) << "the choice is kept";
}

TEST_F(web_pages, a_telephone_shows_all_without_scrolling_aside) {
    be_wide(360);
    open();
    EXPECT_EQ(value("innerWidth"), 360);
    EXPECT_EQ(value("document.scrollingElement.scrollWidth"), 360);
    EXPECT_EQ(value("[...document.querySelectorAll('p, h1, h2, .tools')].filter(e => "
                    "e.getBoundingClientRect().right > 360).length"),
              0);
}

TEST_F(web_pages, code_is_copied_as_it_was_written) {
    open();
    browser.evaluate("navigator.clipboard.writeText = async (text) => { window.copied = text; }");
    browser.click(".copy");
    EXPECT_TRUE(browser.becomes_true("window.copied !== undefined"));
    EXPECT_EQ(value("copied"), "local x = 1\nprint(\"a long line of a script that no telephone shows whole\", x)");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.copy').textContent === 'Copied'"));
}

TEST_F(web_pages, the_keyboard_reaches_every_button_and_shows_where_it_is) {
    open();
    const json tab = {
        {{"type", "key"},
         {"id", "keys"},
         {"actions", {{{"type", "keyDown"}, {"value", "\uE004"}}, {{"type", "keyUp"}, {"value", "\uE004"}}}}}};
    std::set<std::string> reached;
    for (int i = 0; i < 12; ++i) {
        browser.act(tab.dump());
        reached.insert(value("document.activeElement.className").get<std::string>());
        EXPECT_NE(value("getComputedStyle(document.activeElement).outlineStyle"), "none")
            << value("document.activeElement.outerHTML");
        if (reached.contains("copy")) break;
    }
    EXPECT_TRUE(reached.contains("theme"));
    EXPECT_TRUE(reached.contains("copy"));
}

TEST_F(web_pages, request_nothing_and_break_no_rule_of_their_own) {
    open();
    EXPECT_EQ(value("performance.getEntriesByType('resource').length"), 0);
    EXPECT_EQ(value("document.querySelectorAll('script[src], link, iframe').length"), 0);
    EXPECT_EQ(value("document.querySelectorAll('img:not([alt])').length"), 0);
    EXPECT_EQ(value("document.documentElement.lang"), "en");
    // What the policy forbids does not run.
    browser.evaluate(
        "const evil = document.createElement('script'); evil.textContent = 'window.bad = 1'; "
        "document.body.append(evil)");
    EXPECT_EQ(value("window.bad === undefined"), true);
}

}  // namespace test_web_pages
