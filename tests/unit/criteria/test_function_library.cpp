#include "numerics/criteria/function_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/thrown_message.h"

namespace test_function_library {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(function_library, of_polynomials_takes_states_and_inputs) {  // oracle: by hand
    const FunctionLibrary library = polynomial_library({"h"}, {"u"}, 2);
    EXPECT_THAT(library.names, ElementsAre("1", "h", "u", "h^2", "h*u", "u^2"));
    const Matrix values = library_values(library, Matrix{{2.0}, {3.0}}, Matrix{{5.0}, {-1.0}});
    EXPECT_EQ(values, (Matrix{{1, 2, 5, 4, 10, 25}, {1, 3, -1, 9, -3, 1}}));
}

TEST(function_library, reports_what_is_wrong_with_its_values) {
    FunctionLibrary library;
    library.names = {"x", "log(x)"};
    library.values = [](const Matrix& x, const Matrix&) {
        Matrix values(x.rows(), 2);
        values << x, x.array().log().matrix();
        return values;
    };
    const Matrix X{{1.0}, {-2.0}}, U(2, 0);
    EXPECT_THAT(thrown_message([&] { library_values(library, X, U); }),
                HasSubstr("log(x) returned NaN at sample 2 (state values: -2)"));
    library.values = [](const Matrix& x, const Matrix&) { return x; };
    EXPECT_THAT(thrown_message([&] { library_values(library, X, U); }),
                HasSubstr("must return 2 functions of 2 values each, but returned 1 of 2"));
}

}  // namespace test_function_library
