#include "numerics/estimators/recursive/rivsvf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/criteria/denominator_group.h"
#include "numerics/estimators/ivsvf.h"
#include "support/recursive_cases.h"
#include "support/thrown_message.h"

namespace test_rivsvf {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

TEST(rivsvf, with_the_model_of_lssvf_it_gives_ivsvf) {  // oracle: ivsvf, on data of all kinds
    for (const RecursiveCase& one : recursive_cases()) {
        const DenominatorGroup group(one.data, one.structure, 0, Hold::kFoh);
        RecursiveOptions options = recursive(one.lambda);
        const Vector first = group.with_stable_poles(lssvf(one.data, one.structure, cutoff(one.lambda)).theta);
        options.model = one.structure.models(first).front();
        const Fit pass = rivsvf(one.data, one.structure, options);
        const Fit batch = ivsvf(one.data, one.structure, cutoff(one.lambda));
        EXPECT_LT(relative_difference(pass.theta, batch.theta), 1e-8) << one.name;
    }
}

TEST(rivsvf, by_itself_it_ends_near_ivsvf) {  // oracle: ivsvf: other instruments, the same consistent estimate
    const IdData data = course_system_data(0.1, 3);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Fit pass = rivsvf(data, structure, recursive(3));
    Fit batch = ivsvf(data, structure, cutoff(3));
    color_covariance(batch, data, cutoff(3), true);
    for (Index i = 0; i < 3; ++i) EXPECT_LT(std::abs(pass.theta[i] - batch.theta[i]), batch.std[i]) << i;
    EXPECT_LT(relative_difference(pass.std, batch.std), 0.05);
}

TEST(rivsvf, follows_a_parameter_that_jumps) {  // oracle: the truth
    RecursiveOptions options = recursive(3);
    options.forgetting = 0.97;
    EXPECT_LT(
        relative_difference(rivsvf(jumping_data(), TransferStructure::single(1, 0), options).theta, values({1, 4})),
        0.03);
}

TEST(rivsvf, refuses_a_model_that_does_not_suit) {  // oracle: the sentence names the fault
    const IdData data = course_system_data(0.1, 3);
    RecursiveOptions options = recursive(3);
    options.model = TransferFunction(values({1}), values({1, 1}));
    EXPECT_THAT(thrown_message([&] { rivsvf(data, TransferStructure::single(2, 0), options); }), HasSubstr("2 poles"));
    options.model = TransferFunction(values({1}), values({1, -1, 1}));
    EXPECT_THAT(thrown_message([&] { rivsvf(data, TransferStructure::single(2, 0), options); }),
                HasSubstr("must be a stable model"));
}

}  // namespace test_rivsvf
