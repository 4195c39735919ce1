// The two ways of srivc: its passes where they give the whole answer, else a search.
#include <gtest/gtest.h>

#include "numerics/estimators/srivc.h"
#include "numerics/simulation/lsim.h"
#include "support/transfer_cases.h"

namespace test_passes_or_search {

using namespace dynlab;
using namespace dynlab::test;

TEST(passes_or_search, passes_suffice_for_fixed_delays_from_rest_with_one_denominator) {  // oracle: the rule of srivc.h
    const TransferStructure plain = TransferStructure::single(2, 0);
    EXPECT_TRUE(srivc_passes_suffice(plain, {}));
    EXPECT_TRUE(srivc_passes_suffice(TransferStructure::grid(1, 2, Denominators::kPerOutput, {2}, {0}, {0, 0}), {}));
    EXPECT_FALSE(srivc_passes_suffice(TransferStructure::grid(1, 2, Denominators::kPerChannel, {2}, {0}, {0, 0}), {}));
    TransferStructure delayed = plain;
    delayed.free_delays = true;
    EXPECT_FALSE(srivc_passes_suffice(delayed, {}));
    FitOptions moving, offset, held;
    moving.initial_state = InitialState::kEstimate;
    offset.offset = Offset::kEstimate;
    held.fixed = {{"a1", 3}};
    for (const FitOptions& options : {moving, offset, held}) EXPECT_FALSE(srivc_passes_suffice(plain, options));
}

// oracle: the passes alone
TEST(passes_or_search, a_record_that_the_passes_settle_on_has_their_answer) {
    const IdData data = course_record(0.4, 11);
    const TransferStructure structure = TransferStructure::single(2, 0);
    EXPECT_EQ(srivc(data, structure).theta, srivc_by_passes(data, structure, {}).theta);
}

TEST(passes_or_search, a_start_that_is_given_is_searched_from) {  // oracle: the least loss is the same from anywhere
    const IdData data = course_record(0.4, 11);
    const TransferStructure structure = TransferStructure::single(2, 0);
    SearchAids aids;
    aids.start = Vector(srivc(data, structure).theta * 1.2);
    EXPECT_LT(relative_difference(srivc(data, structure, {}, aids).theta, srivc(data, structure).theta), 1e-5);
}

}  // namespace test_passes_or_search
