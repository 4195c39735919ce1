#include "numerics/validation/intervals/refitted_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/thrown_message.h"

namespace test_refitted_output {

using namespace dynlab;
using testing::HasSubstr;

IdData simulated_data(double noise, double delay = 0) {
    const Vector u = prbs(5, 6);
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}}, 0, delay);
    return IdData(Matrix(lsim(G, u, 0.05) + noise * RandomStream(1).normal(u.size())), Matrix(u), 0.05);
}

TEST(refitted_output, fits_what_coe_fits) {  // oracle: coe, from a start that is not its end
    const IdData data = simulated_data(0.05);
    FitOptions tight;
    tight.tolerance = 1e-10;
    const Fit reference = coe(data, TransferStructure::single(2, 0), tight);
    const RefittedOutput model(data, {TransferStructure::single(2, 0), {}, 1.05 * reference.theta});
    const Fit found = model.fit();
    EXPECT_LT((found.theta - reference.theta).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((found.std - reference.std).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_NEAR(found.loss, reference.loss, 1e-9);
    const Vector errors = model.measured() - model.simulated(found);
    EXPECT_NEAR(errors.squaredNorm() / static_cast<double>(errors.size()), found.loss, 1e-12);
}

TEST(refitted_output, reports_models_that_these_data_move) {  // oracle: coe of these data and of others
    const IdData data = simulated_data(0.05);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const Vector theta = coe(data, structure).theta;
    const RefittedOutput own(data, {structure, {}, theta}), others(data, {structure, {}, 1.2 * theta});
    EXPECT_FALSE(own.moved(own.fit()));
    const auto reported = others.moved(others.fit());
    ASSERT_TRUE(reported);
    EXPECT_THAT(message_text(*reported), HasSubstr("the intervals refer to the new value"));
}

TEST(refitted_output, fits_processes_with_start_and_offset) {  // oracle: procsrivc
    IdData data = simulated_data(0.02, 0.23);
    data.experiments[0].y.array() += 3;
    const Fit reference = procsrivc(data, ProcessStructure::parse("P2D"));
    const RefittedOutput model(data, {{}, ProcessStructure::parse("P2D"), reference.theta, reference.start});
    const Fit found = model.fit();
    EXPECT_LT(((found.theta - reference.theta).array() / reference.std.array()).abs().maxCoeff(), 0.01);
    EXPECT_EQ(model.fitted().names(), reference.names);
}

TEST(refitted_output, holds_parameters) {  // oracle: coe with the parameter fixed
    const IdData data = simulated_data(0.05);
    FitOptions fixed;
    fixed.fixed = {{"a1", 4.5}};
    const Fit reference = coe(data, TransferStructure::single(2, 0), fixed);
    const RefittedOutput model(data, {TransferStructure::single(2, 0), {}, Vector{{4, 3, 2}}});
    const Fit found = model.fit({{model.fitted().place_of("a1"), 4.5}});
    EXPECT_DOUBLE_EQ(found.theta[0], 4.5);
    EXPECT_LT((found.theta - reference.theta).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_EQ(found.std[0], 0);
}

TEST(refitted_output, takes_other_outputs) {  // oracle: a fit to data with these outputs
    const IdData data = simulated_data(0.05), other = simulated_data(0);
    const RefittedOutput model(data, {TransferStructure::single(2, 0), {}, Vector{{3.5, 3.2, 2}}});
    const Vector outputs = other.experiments[0].y.col(0);
    EXPECT_LT((model.fit({}, nullptr, &outputs).theta - Vector{{4, 3, 2}}).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(refitted_output, refuses_what_it_cannot_repeat) {
    const IdData data = simulated_data(0.05);
    const FittedOutput fitted{TransferStructure::single(2, 0), {}, Vector{{4, 3, 2}}};
    EXPECT_THAT(thrown_message([&] { RefittedOutput(data.range(1, 3), fitted); }),
                HasSubstr("estimates 3 values and needs more samples than that"));
    EXPECT_THAT(thrown_message([&] { RefittedOutput(data, fitted.at(Vector::Constant(3, kNaN))); }),
                HasSubstr("finite"));
    EXPECT_THAT(thrown_message([&] { fitted.place_of("Td"); }), HasSubstr("its parameters are a1, a2, b0"));
    const IdData two(Matrix::Random(50, 2), Matrix::Random(50, 1), 1);
    EXPECT_THAT(thrown_message([&] { RefittedOutput(two, fitted); }), HasSubstr("select one of each"));
}

}  // namespace test_refitted_output
