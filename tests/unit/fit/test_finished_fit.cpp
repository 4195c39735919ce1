// What methods have in common at their end. Oracle: what each call is given, recorded.
#include "numerics/fit/finished_fit.h"

#include <gtest/gtest.h>

#include "numerics/fit/integrated_input.h"
#include "numerics/signals/prbs.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::test {
namespace test_finished_fit {

IdData simulated_data() {
    const Vector u = prbs(6, 5);
    return IdData(Matrix(lsim(TransferFunction(Vector{{2.0}}, Vector{{1.0, 3.0}}), u, 0.1)), Matrix(u), 0.1);
}

Fit fit_of_first_order() {
    Fit fit;
    fit.structure = TransferStructure::single(1, 0);
    fit.models = {TransferFunction(Vector{{2.0}}, Vector{{1.0, 3.0}})};
    fit.names = {"a1", "b0"};
    fit.theta = Vector{{3.0, 2.0}};
    fit.std = Vector::Ones(2);
    fit.covariance = Matrix::Identity(2, 2);
    return fit;
}

TEST(finished_fit, is_the_estimate_of_the_data_where_no_integrator_is_asked_for) {
    const IdData data = simulated_data();
    FitOptions options = FitOptions().from_rest();
    int calls = 0;
    const Fit fit = finished_fit(data, options, [&](const IdData& seen, const FitOptions& expected) {
        ++calls;
        EXPECT_EQ(&seen, &data);
        EXPECT_FALSE(expected.integration);
        return fit_of_first_order();
    });
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(fit.models.front().pole_count(), 1);
}

TEST(finished_fit, with_an_integrator_the_method_sees_integrated_inputs_and_the_model_gets_a_pole_at_zero) {
    const IdData data = simulated_data();
    FitOptions options = FitOptions().from_rest();
    options.integration = true;
    const Fit fit = finished_fit(data, options, [&](const IdData& seen, const FitOptions& expected) {
        EXPECT_EQ(seen.experiments.front().u, integrated_inputs(data).experiments.front().u);
        EXPECT_FALSE(expected.integration);
        return fit_of_first_order();
    });
    EXPECT_EQ(fit.models.front().pole_count(), 2);
    EXPECT_EQ(fit.models.front().poles().cwiseAbs().minCoeff(), 0);
}

}  // namespace test_finished_fit
}  // namespace dynlab::test
