#include "numerics/criteria/monomials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/thrown_message.h"

namespace test_monomials {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> texts(const Monomials& monomials, const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (Index i = 0; i < monomials.count(); ++i) all.push_back(monomials.text(i, names));
    return all;
}

TEST(monomials, stand_in_the_order_of_degrees) {  // oracle: written by hand
    EXPECT_THAT(texts(Monomials("test", 2, 3), {"x", "u"}),
                ElementsAre("1", "x", "u", "x^2", "x*u", "u^2", "x^3", "x^2*u", "x*u^2", "u^3"));
    EXPECT_THAT(texts(Monomials("test", 0, 2), {}), ElementsAre("1"));
}

TEST(monomials, are_as_many_as_combinations) {  // oracle: (n + d)!/(n! d!)
    EXPECT_EQ(Monomials("test", 5, 3).count(), 56);
    EXPECT_EQ(Monomials("test", 3, 5).count(), 56);
}

TEST(monomials, have_the_values_of_their_texts) {  // oracle: powers by std::pow
    const Monomials monomials("test", 3, 4);
    const Matrix Z{{0.5, -2, 3}, {1.5, 0.25, -1}};
    const Matrix values = monomials.values(Z);
    for (Index i = 0; i < monomials.count(); ++i) {
        for (Index row = 0; row < 2; ++row) {
            EXPECT_DOUBLE_EQ(values(row, i), monomials.value(i, Vector(Z.row(row))));
        }
    }
    // x^2*z of degree 3
    for (Index i = 0; i < monomials.count(); ++i)
        if (monomials.text(i, {"x", "y", "z"}) == "x^2*z") {
            EXPECT_DOUBLE_EQ(values(0, i), std::pow(0.5, 2) * 3);
        }
    EXPECT_EQ(monomials.degree(monomials.count() - 1), 4);
}

TEST(monomials, that_are_too_many_are_refused) {
    EXPECT_THAT(thrown_message([] { Monomials("narx", 40, 4); }), HasSubstr("more than 2000 monomials"));
    EXPECT_THAT(thrown_message([] { Monomials("narx", 2, 10); }), HasSubstr("`degree` must be between 0 and 9"));
    EXPECT_THAT(thrown_message([] { Monomials("narx", 2, -1); }), HasSubstr("narx: `degree`"));
}

}  // namespace test_monomials
