// What the scripts say while they install, build and test. Oracle: the lines that they are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace dynlab::test {
namespace test_build_scripts {
using testing::HasSubstr;

TEST(build_scripts, progress_is_what_was_said_however_slowly_it_comes) {
    const Workbench bench;
    const ChildResult reported = bench.shell("bash -c '. " DYNLAB_SOURCE_DIR
                                             "/scripts/common.sh; "
                                             "(printf 4; sleep 3; echo 2; sleep 10) | tell_progress Building'");
    EXPECT_THAT(reported.error_output, HasSubstr("Building: 42 % after 1"));
}

// Without a terminal; a line of a test's own output stays, whatever it says.
TEST(build_scripts, of_ctest_s_lines_those_of_suites_that_pass_are_left_out) {
    const Workbench bench;
    bench.write(
        "lines",
        "      Start 12: srivc\n  1/520 Test  #12: srivc ......   Passed    0.50 sec\n"
        "  2/520 Test   #7: coe ........***Failed    0.61 sec\n[  FAILED  ] coe.x\na Start 3: of a test   Passed\n"
        "99% tests passed, 1 tests failed out of 520\n");
    const ChildResult reported = bench.shell("bash -c '. " DYNLAB_SOURCE_DIR "/scripts/common.sh; tell_tests < lines'");
    EXPECT_EQ(
        reported.output,
        "  2/520 Test   #7: coe ........***Failed    0.61 sec\n[  FAILED  ] coe.x\na Start 3: of a test   Passed\n"
        "99% tests passed, 1 tests failed out of 520\n");
    EXPECT_EQ(reported.error_output, "");
}

TEST(build_scripts, wrong_words_for_the_tests_are_named_before_anything_is_built) {
    const Workbench bench;
    const auto refused = [&](const std::string& words) {
        const ChildResult run = bench.shell(DYNLAB_SOURCE_DIR "/scripts/test " + words);
        EXPECT_EQ(run.exit_code, 2) << words;
        EXPECT_EQ(run.output, "") << words;
        return run.error_output;
    };
    EXPECT_THAT(refused("--quick srivc"),
                HasSubstr("unexpected word 'srivc'; for suites of this name: scripts/test --quick -R srivc"));
    EXPECT_THAT(refused("srivc"), HasSubstr("scripts/test -R srivc"));
    EXPECT_THAT(refused("--quik"), HasSubstr("unknown option --quik"));
    EXPECT_THAT(refused("-R srivc --quick"), HasSubstr("--quick must be the first word"));
    EXPECT_THAT(refused("--quick --long"), HasSubstr("--long must be the first word"));
}

}  // namespace test_build_scripts
}  // namespace dynlab::test
