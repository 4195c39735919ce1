// The page on which a prompt's figures appear. Oracle: what a browser shows of it.
#include "app/live/figure_viewer.h"
#include "figures/figure.h"

#include <gtest/gtest.h>

#include <memory>

#include "base/languages.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "support/browser.h"

namespace test_figure_viewer {
using namespace dynlab;
using test::Browser;

Figure figure_titled(const std::string& title) {
    Figure figure;
    figure.panels.resize(1);
    figure.panels[0].title = Message::verbatim(title);
    Curve curve;
    curve.x = curve.y = Vector::LinSpaced(5, 0, 1);
    figure.panels[0].curves.push_back(curve);
    return figure;
}

TEST(figure_viewer, shows_figures_as_they_are_made_the_newest_first) {
    FigureViewer viewer;
    Browser browser;
    browser.open(viewer.address());
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').innerText.includes('no figures yet')"));
    viewer.show("figure-1.pdf", figure_titled("First"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('img')?.naturalWidth > 100"));
    viewer.show("figure-2.pdf <b>", figure_titled("Second"));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('img').length === 2"));
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('figcaption')].map(n => n.innerText)"),
              "[\"figure-2.pdf <b>\",\"figure-1.pdf\"]");
    browser.open(viewer.address());  // again: all that were made
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('img').length === 2"));
}

TEST(figure_viewer, figures_can_be_read_off_as_in_documents) {
    FigureViewer viewer;
    Browser browser;
    browser.open(viewer.address());
    viewer.show("figure-1.pdf", figure_titled("First </script><b>"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('figure .plot')?.clientWidth > 100"));
    browser.evaluate(
        "const plot = document.querySelector('.plot').plot, panel = plot.panels[0]; plot.setCursor({panel, x: "
        "panel.place(0.5, 0.5)[0], y: panel.place(0.5, 0.5)[1]})");
    EXPECT_TRUE(browser.becomes_true("/0\\.50/.test(document.querySelector('.reading').innerText)"));
    browser.evaluate("document.querySelector('.plot .data').click()");
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.samples tbody tr').length"), "5");
    viewer.show("figure-2.pdf", figure_titled("Second"));
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('figure .plot').length === 2"));
}

/// A prompt has no document whose language the page could take.
TEST(figure_viewer, speaks_the_language_of_the_browser) {
    auto viewer = std::make_unique<FigureViewer>();
    Browser browser;
    browser.devtools("Network.setUserAgentOverride", R"({"userAgent": "Chromium", "acceptLanguage": "fr-FR"})");
    browser.open(viewer->address());
    const auto state_is = [&](const std::string& pattern) {
        return browser.becomes_true("/" + pattern + "/.test(document.getElementById('state').innerText)");
    };
    EXPECT_TRUE(state_is("^aucune figure encore.; tapez, par exemple, step\\(tf\\("));
    EXPECT_EQ(browser.evaluate("return [document.documentElement.lang, document.getElementById('name').innerText]"),
              "[\"fr\",\"Figures\"]");
    viewer->show("figure-1.pdf", figure_titled("First"));
    EXPECT_TRUE(state_is("^1$"));
    viewer.reset();
    EXPECT_TRUE(state_is("^dynlab s'est arrêté.; cette page montre les dernières figures$"));
}

/// A page needs nothing of a language but its catalog.
TEST(figure_viewer, speaks_a_language_that_came_with_a_catalog) {
    add_language(
        "eo",
        "msgctxt \"decimal sign\"\nmsgid \".\"\nmsgstr \",\"\n\nmsgid \"Figures\"\nmsgstr "
        "\"Figuroj\"\n\nmsgid \"no figures yet; enter, for example, {}\"\nmsgstr \"tajpu {1}: ankoraŭ neniu\"\n");
    FigureViewer viewer;
    Browser browser;
    browser.devtools("Network.setUserAgentOverride", R"({"userAgent": "Chromium", "acceptLanguage": "eo-XX"})");
    browser.open(viewer.address());
    EXPECT_TRUE(browser.becomes_true(
        "document.getElementById('state').innerText === 'tajpu step(tf({1}, {1, 1})): ankoraŭ neniu'"));
    EXPECT_EQ(browser.evaluate("return [document.documentElement.lang, document.getElementById('name').innerText]"),
              "[\"eo\",\"Figuroj\"]");
}

TEST(figure_viewer, forgets_the_oldest) {
    FigureViewer viewer;
    for (int i = 0; i < 103; ++i) viewer.show(std::to_string(i), figure_titled("A figure"));
    Browser browser;
    browser.open(viewer.address());
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('img').length === 100"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('main').lastElementChild.innerText"), "\"3\"");
}

TEST(figure_viewer, the_prompt_has_one_when_asked) {
    ChildOptions prompt;
    prompt.command = {DYNLAB_PROGRAM, "--view"};
    prompt.environment = {{"DYNLAB_HOME", DYNLAB_SOURCE_DIR}};
    prompt.input = "print(1 + 1)\n";
    const ChildResult result = run_child(prompt, "dynlab");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.output, "2\n");
    EXPECT_EQ(result.error_output.rfind("figures: http://dynlab-", 0), 0u) << result.error_output;
}

}  // namespace test_figure_viewer
