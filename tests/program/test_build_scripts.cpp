// What the scripts say while they install and build. Oracle: the lines that they are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace dynlab::test {
namespace test_build_scripts {
using testing::HasSubstr;

TEST(build_scripts, progress_is_what_was_said_however_slowly_it_comes) {
    const Workbench bench;
    const ChildResult told = bench.shell("bash -c '. " DYNLAB_SOURCE_DIR
                                         "/scripts/common.sh; "
                                         "(printf 4; sleep 3; echo 2; sleep 10) | tell_progress Building'");
    EXPECT_THAT(told.error_output, HasSubstr("Building: 42 % after 1"));
}

}  // namespace test_build_scripts
}  // namespace dynlab::test
