#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/signals/random.h"
#include "numerics/statistics/identifiability.h"

namespace test_identifiability {

using namespace dynlab;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Sensitivities of outputs that depend on the ratio k/m and on c.
Matrix of_ratio(double k, double m) {
    RandomStream random(3);
    const Vector by_ratio = random.normal(50), by_c = random.normal(50);
    Matrix J(50, 3);
    J << by_ratio / m, -by_ratio * k / (m * m), by_c;
    return J;
}

TEST(identifiability, names_a_combination_and_how_it_changes) {  // oracle: k/m stays when both grow by the same share
    const Ambiguity found = find_ambiguity(of_ratio(3, 0.02), {"k", "m", "c"}, Vector{{3, 0.02, 1}}, 10);
    EXPECT_THAT(found.parameters, ElementsAre(true, true, false));
    ASSERT_EQ(found.sentences.size(), 1u);
    EXPECT_THAT(message_text(found.sentences[0]), HasSubstr("cannot separate k, m"));
    EXPECT_THAT(message_text(found.sentences[0]), HasSubstr("k +1 %, m +1 %"));
}

TEST(identifiability, says_which_parameter_has_no_effect) {  // oracle: a column of zeros
    Matrix J = of_ratio(3, 0.02);
    J.col(1) = RandomStream(5).normal(50);
    J.col(2).setZero();
    const Ambiguity found = find_ambiguity(J, {"k", "m", "c"}, Vector{{3, 0.02, 1}}, 10);
    EXPECT_THAT(found.parameters, ElementsAre(false, false, true));
    ASSERT_EQ(found.sentences.size(), 1u);
    EXPECT_THAT(message_text(found.sentences[0]), HasSubstr("do not depend on c"));
}

TEST(identifiability, reports_nothing_if_all_is_identifiable) {  // oracle: independent columns, in units 10^9 apart
    Matrix J(50, 2);
    J << RandomStream(1).normal(50), 1e9 * RandomStream(2).normal(50);
    const Ambiguity found = find_ambiguity(J, {"a", "b"}, Vector{{1, 1e-9}}, 10);
    EXPECT_THAT(found.sentences, IsEmpty());
    EXPECT_THAT(found.parameters, ElementsAre(false, false));
}

}  // namespace test_identifiability
