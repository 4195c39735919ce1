// What a live page offers to learn by: rigs that move. Oracle: the files that the test writes,
// and what a reader sees.
#include <gtest/gtest.h>

#include "support/preview.h"

namespace test_preview_learning {
using namespace dynlab;
using namespace dynlab::test;

using preview_learning = preview_page;

const std::string kMotion =
    "-- %% id=moving\nlocal t = linspace(0, 4, 201)\n"
    "motion{rig = \"thruster\", t = t, measured = {force = 20*sin(t)}, simulated = {force = 18*sin(t)}}\n";

TEST_F(preview_learning, rigs_move_above_their_figure) {
    write(kHead + kFirst + kMotion);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.comes("document.querySelector('.motion .stage')?.width > 100"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('.motion').motion.now"), "0");
    browser.click(".motion button");
    EXPECT_TRUE(browser.comes("document.querySelector('.motion').motion.now > 0.2"));
    EXPECT_TRUE(
        browser.comes("/force: . measured .* N, . simulated .* N/.test(document.querySelector('.motion').innerText)"));
}

}  // namespace test_preview_learning
