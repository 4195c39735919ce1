// Questions that answer, in a real browser. Oracle: the notation, written here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "document_fixture.h"
#include "support/browser.h"

namespace dynlab {
namespace test_choice_pages {

using nlohmann::json;
using test::Browser;
using testing::Not;

const char* const kQuestions = R"(# Two questions

::: choice
What is $2^3$?

1. Count
2. the factors.

- [ ] Six.

  That is 2 times 3.
- [x] *Eight*.

  Three factors `2`.
:::

::: choice
Which are even?

- [x] Two.

  Two halves of one.
- [x] Four.

  Two halves of two.
- [ ] Five.

  One is left over.
:::
)";

class choice_pages : public DocumentTest {
  protected:
    void open(const std::string& text = kQuestions) {
        browser.open("file://" + make(text, "page.html").string());
        ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.option').length > 0"));
    }
    json value(const std::string& expression) { return json::parse(browser.evaluate("return " + expression)); }
    std::string feedback(int option) {
        return value("document.querySelectorAll('.verdict')[" + std::to_string(option) + "].innerText");
    }
    void choose(int option) {
        browser.evaluate("document.querySelectorAll('.option')[" + std::to_string(option) + "].scrollIntoView()");
        browser.click("li:has(> .option)[data-place='" + std::to_string(option) + "'] > .option");
    }
    void number_options() {
        browser.evaluate("document.querySelectorAll('li:has(> .option)').forEach((li, i) => li.dataset.place = i)");
    }
    void press(const std::string& key) {
        const json actions = {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}};
        browser.act(json::array({{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}).dump());
    }
    Browser browser;
};

TEST_F(choice_pages, a_click_says_right_or_wrong_and_why) {
    open();
    number_options();
    EXPECT_EQ(value("document.querySelectorAll('.option').length"), 5);
    EXPECT_EQ(value("document.querySelector('main').innerText.includes('times 3')"), false) << "nothing is told before";
    choose(0);
    EXPECT_EQ(feedback(0), "Wrong. That is 2 times 3.");
    EXPECT_EQ(feedback(1), "");
    choose(1);
    EXPECT_EQ(feedback(1), "Right. Three factors 2.");
    EXPECT_EQ(value("document.querySelectorAll('em').length"), 1) << "words keep their looks";
    choose(4);
    choose(2);
    EXPECT_EQ(feedback(4), "Wrong. One is left over.");
    EXPECT_EQ(feedback(2), "Right. Two halves of one.");
    EXPECT_EQ(feedback(3), "");
    EXPECT_EQ(value("[...document.querySelectorAll('li.right')].map(li => li.dataset.place).join()"), "1,2");
    EXPECT_EQ(value("[...document.querySelectorAll('li.wrong')].map(li => li.dataset.place).join()"), "0,4");
    choose(4);  // taken back
    EXPECT_EQ(feedback(4), "");
    EXPECT_EQ(value("document.querySelectorAll('li.wrong').length"), 1);
}

TEST_F(choice_pages, obey_the_keyboard_and_are_readable_by_screen_readers) {
    open("---\nlang: fr\n---\n" + std::string(kQuestions));
    browser.evaluate("document.querySelector('.option').focus()");
    press("\uE007");  // Enter
    EXPECT_EQ(feedback(0), "Faux. That is 2 times 3.");
    press("\uE004");  // Tab
    press(" ");
    EXPECT_EQ(feedback(1), "Juste. Three factors 2.");
    EXPECT_EQ(value("document.activeElement.getAttribute('aria-pressed')"), "true");
    EXPECT_EQ(value("document.querySelector('.verdict').getAttribute('aria-live')"), "polite");
}

TEST_F(choice_pages, what_was_chosen_stays_where_a_page_sets_the_question_again) {
    open();
    browser.evaluate("document.querySelectorAll('.option')[0].click()");
    const std::string page = read(file("page.html"));
    const std::size_t begin = page.find("<div class=\"choice\""), end = page.find("<div class=\"choice\"", begin + 1);
    const std::string html = json(page.substr(begin, end - begin)).dump();
    browser.evaluate(
        "const box = document.querySelector('div.choice'), fresh = document.createElement('div');"
        "fresh.innerHTML = " +
        html + "; box.replaceWith(fresh); dynlabChoices.enliven(fresh)");
    EXPECT_EQ(feedback(0), "Wrong. That is 2 times 3.");
    EXPECT_EQ(feedback(1), "");
}

TEST_F(choice_pages, without_scripts_the_answers_are_folded_and_paper_shows_none) {
    open();
    const std::string folded = "getComputedStyle(document.querySelector('details.answer')).display";
    EXPECT_EQ(value(folded), "none");
    browser.evaluate("document.querySelector('.option').click()");
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": "print"})");
    EXPECT_EQ(value("getComputedStyle(document.querySelector('.verdict')).display"), "none");
    browser.devtools("Emulation.setEmulatedMedia", R"({"media": ""})");
    browser.devtools("Emulation.setScriptExecutionDisabled", R"({"value": true})");
    browser.open("file://" + file("page.html").string());
    EXPECT_EQ(value("document.querySelectorAll('.option').length"), 0);
    EXPECT_EQ(value(folded), "block");
}

TEST_F(choice_pages, carry_no_marks_that_an_author_could_misuse) {
    const std::string page = html("::: {.question right=\"1\\\"><script>\"}\nOne.\n:::\n");
    EXPECT_THAT(page, testing::HasSubstr("<div class=\"choice\" data-right=\"1\">"));
}

}  // namespace test_choice_pages
}  // namespace dynlab
