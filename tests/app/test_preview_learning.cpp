// Learning aids of a live page: questions with answers and animated plants. Oracle: the files that the test writes, and
// what a reader sees.
#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "support/preview.h"

namespace test_preview_learning {
using namespace dynlab;
using namespace dynlab::test;

using preview_learning = preview_page;

const std::string kQuestion =
    "-- %% [markdown]\n-- Some words.\n--\n-- ::: choice\n-- What is two and two?\n--\n-- - [ ] Three.\n--\n"
    "--   One is missing.\n-- - [x] Four.\n--\n--   Count them.\n-- :::\n\n";
const std::string kMotion =
    "-- %% id=moving\nlocal t = linspace(0, 4, 201)\n"
    "motion{plant = \"thruster\", t = t, measured = {force = 20*sin(t)}, simulated = {force = 18*sin(t)}}\n";

TEST_F(preview_learning, questions_answer_and_stay_answered_while_the_document_changes) {
    write(kHead + kQuestion + kFirst);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.option').length === 2"));
    browser.click(".option");
    const std::string feedback_shown = "document.querySelector('.verdict').innerText === 'Wrong. One is missing.'";
    EXPECT_TRUE(browser.becomes_true(feedback_shown));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.chosen').length"), "0") << "no place was chosen";
    std::string changed = kQuestion;
    changed.replace(changed.find("Count them"), 10, "Count again");
    write(kHead + changed + kFirst);
    ASSERT_TRUE(browser.becomes_true("document.getElementById('document').innerHTML.includes('Count again')"));
    EXPECT_TRUE(browser.becomes_true(feedback_shown));
    browser.evaluate("document.querySelectorAll('.option')[1].click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('.verdict')[1].innerText === 'Right. Count again.'"));
}

/// As a lesson has them: behind its literature.
TEST_F(preview_learning, questions_below_the_literature_answer_too) {
    write("@book{ljung, author = {Ljung, Lennart}, title = {A book}, year = {1999}}\n", "references.bib");
    write(
        "-- ---\n-- title: A document\n-- bibliography: references.bib\n-- ---\n\n-- %% [markdown]\n-- After "
        "[@ljung].\n--\n"
        "-- ::: references\n-- :::\n--\n-- # Check yourself\n\n" +
        kQuestion);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.option').length === 2"));
    browser.click(".option");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.verdict').innerText === 'Wrong. One is missing.'"));
    write(read_text(file()) + kFirst);
    ASSERT_TRUE(browser.becomes_true("document.body.innerText.includes('Words at the beginning.')"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.verdict').innerText === 'Wrong. One is missing.'"));
}

TEST_F(preview_learning, plants_move_above_their_figure) {
    write(kHead + kFirst + kMotion);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.motion .stage')?.width > 100"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('.motion').motion.now"), "0");
    browser.click(".motion button");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.motion').motion.now > 0.2"));
    EXPECT_TRUE(browser.becomes_true(
        "/force: . measured .* N, . simulated .* N/.test(document.querySelector('.motion').innerText)"));
}

}  // namespace test_preview_learning
