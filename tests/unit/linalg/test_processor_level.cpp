// Oracle: the C library, which reports the levels of this processor.
#include "numerics/linalg/processor_level.h"

#include <gtest/gtest.h>

#include <string>

namespace dynlab {
namespace test_processor_level {

TEST(processor_level, is_one_that_the_processor_has) {
    const std::string level = processor_level();
    __builtin_cpu_init();
    const bool has = level == "x86-64-v4"   ? __builtin_cpu_supports("x86-64-v4")
                     : level == "x86-64-v3" ? __builtin_cpu_supports("x86-64-v3")
                     : level == "x86-64-v2" ? __builtin_cpu_supports("x86-64-v2")
                                            : level == "x86-64";
    EXPECT_TRUE(has) << level;
#if defined(__AVX512F__)
    EXPECT_EQ(level, "x86-64-v4") << "what this test is compiled for";
#endif
}

}  // namespace test_processor_level
}  // namespace dynlab
