#include "data_io/variable_bytes.h"

#include <gtest/gtest.h>

#include <random>

#include "platform/error.h"
#include "sample_variables.h"

namespace dynlab {
namespace test_variable_bytes {

// Oracle: the variables that went in.
TEST(variable_bytes, carry_every_kind) {
    const VariableTable variables = sample_variables();
    EXPECT_TRUE(equal(variables_of(bytes_of(variables)), variables));
    EXPECT_TRUE(equal(variables_of(bytes_of({})), {}));
}

TEST(variable_bytes, every_beginning_is_refused) {
    const std::string bytes = bytes_of(sample_variables());
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_THROW(variables_of(std::string_view(bytes).substr(0, length)), EnvironmentError) << length;
    }
    EXPECT_THROW(variables_of(bytes + "x"), EnvironmentError);
}

TEST(variable_bytes, wrong_bytes_give_variables_or_an_error) {
    std::mt19937 random(7);
    const std::string bytes = bytes_of(sample_variables());
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string wrong = bytes;
        for (unsigned k = 0; k <= random() % 4; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        try {
            variables_of(wrong);
        } catch (const EnvironmentError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace test_variable_bytes
}  // namespace dynlab
