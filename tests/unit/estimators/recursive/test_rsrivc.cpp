#include "numerics/estimators/recursive/rsrivc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/criteria/denominator_group.h"
#include "numerics/estimators/srivc.h"
#include "support/recursive_cases.h"
#include "support/thrown_message.h"

namespace test_rsrivc {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

// oracle: one pass of srivc from the same model, by its sums (filters/transfer_filters.h), on data of all kinds
TEST(rsrivc, with_a_fixed_model_it_is_one_pass_of_srivc) {
    for (const RecursiveCase& one : recursive_cases()) {
        const DenominatorGroup group(one.data, one.structure, 0, Hold::kFoh);
        const Vector start = group.with_stable_poles(lssvf(one.data, one.structure, cutoff(one.lambda)).theta);
        RecursiveOptions options = recursive(one.lambda);
        options.model = one.structure.models(start).front();
        EXPECT_LT(
            relative_difference(rsrivc(one.data, one.structure, options).theta, solve_equations(group.refined(start))),
            1e-8)
            << one.name;
    }
}

TEST(rsrivc, the_estimate_of_srivc_stays) {  // oracle: srivc
    const IdData data = course_system_data(0.2, 5);
    const TransferStructure structure = TransferStructure::single(2, 0);
    FitOptions exact;
    exact.tolerance = 1e-12;
    const Fit batch = srivc(data, structure, exact);
    RecursiveOptions options = recursive(3);
    options.model = batch.models.front();
    const Fit pass = rsrivc(data, structure, options);
    EXPECT_LT(relative_difference(pass.theta, batch.theta), 1e-8);
    EXPECT_LT(relative_difference(pass.std, batch.std), 0.1);  // the variance comes from part of the errors
}

TEST(rsrivc, by_itself_it_ends_near_srivc) {  // oracle: srivc
    const IdData data = course_system_data(0.2, 5);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Fit pass = rsrivc(data, structure, recursive(3)), batch = srivc(data, structure);
    for (Index i = 0; i < 3; ++i) EXPECT_LT(std::abs(pass.theta[i] - batch.theta[i]), batch.std[i]) << i;
}

TEST(rsrivc, follows_parameters_that_change) {  // oracle: the truth
    RecursiveOptions options = recursive(3);
    options.forgetting = 0.97;
    const TransferStructure structure = TransferStructure::single(1, 0);
    EXPECT_LT(relative_difference(rsrivc(jumping_data(), structure, options).theta, values({1, 4})), 0.03);
    options.forgetting = 1;
    options.drift = values({0, 1e-3});
    EXPECT_LT(relative_difference(rsrivc(jumping_data(), structure, options).theta, values({1, 4})), 0.05);
}

TEST(rsrivc, can_be_stopped) {  // oracle: the termination
    RecursiveOptions options = recursive(3);
    int asked = 0;
    options.cancel = [&] { return ++asked > 1; };
    const Vector u = prbs(10, 10);
    const IdData data(Matrix(lsim(TransferFunction(values({2}), values({1, 4, 3})), u, 0.05)), Matrix(u), 0.05);
    EXPECT_EQ(rsrivc(data, TransferStructure::single(2, 0), options).termination, Termination::kCanceled);
}

}  // namespace test_rsrivc
