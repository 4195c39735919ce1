// What must not change what is learned from data: units of signals and of time, and where time begins.
#include <gtest/gtest.h>

#include "numerics/estimators/learning/dmdc.h"
#include "numerics/estimators/learning/narx.h"
#include "numerics/estimators/learning/sindy.h"
#include "support/nonlinear_data.h"

namespace test_learning_properties {

using namespace dynlab;
using namespace dynlab::test;

/// A forced oscillator whose spring hardens: two states and an input.
IdData oscillator() {
    RandomStream chance(3);
    const Index N = 600;
    Matrix y(N, 2), u(N, 1);
    Vector x = Vector::Zero(2);
    for (Index k = 0; k < N; ++k) {
        u(k, 0) = k % 15 == 0 ? 2 * chance.uniform() - 1 : u(k - 1, 0);
        y.row(k) = x.transpose();
        for (int i = 0; i < 100; ++i) {
            const double rate = -x[0] - 0.4 * x[1] - 0.5 * x[0] * x[0] * x[0] + u(k, 0);
            x += 0.001 * Vector{{x[1] + 0.0005 * rate, rate}};
        }
    }
    return IdData(y, u, 0.1);
}

IdData scaled(IdData data, double y, double u, double time) {
    data.Ts *= time;
    for (Experiment& experiment : data.experiments) {
        experiment.y *= y;
        experiment.u *= u;
        experiment.start_time = 7;
    }
    return data;
}

Matrix free_run(const FreeRunModel& model, const IdData& data) {
    return model.free_run(data, 0, Vector()).output;
}

TEST(learning_properties, sindy_finds_the_same_in_other_units) {  // oracle: the same data in other units
    for (const bool weak : {false, true}) {
        const auto found = [&](const IdData& data) {
            SindyOptions options;
            options.weak = weak;
            return sindy(data, polynomial_library(data.output_names, data.input_names, 3), options);
        };
        const IdData data = oscillator(), other = scaled(data, 100, 0.01, 60);
        const SindyFit one = found(data), two = found(other);
        EXPECT_EQ(one.fit.names, two.fit.names);
        EXPECT_GE(one.fit.names.size(), 4u);
        const Matrix run = free_run(*one.model, data);
        EXPECT_LT((100 * run - free_run(*two.model, other)).cwiseAbs().maxCoeff(), 1e-4 * run.cwiseAbs().maxCoeff());
    }
}

TEST(learning_properties, narx_finds_the_same_in_other_units) {  // oracle: the same data in other units
    const IdData data = with_relative_noise(oscillator(), 0.01, 1).select({1}, {1});
    const IdData other = scaled(data, 100, 0.01, 60);
    const NarxLags lags{2, {2}, {1}};
    const NarxFit one = narx(data, lags, {3, 0}), two = narx(other, lags, {3, 0});
    EXPECT_EQ(one.fit.names, two.fit.names);
    EXPECT_NEAR(one.fit.fit_percent[0], two.fit.fit_percent[0], 1e-6);
    EXPECT_NEAR(one.fit.noise_variance[0] * 1e4, two.fit.noise_variance[0], 1e-8 * two.fit.noise_variance[0]);
}

TEST(learning_properties, dmdc_finds_the_same_in_other_units) {  // oracle: the same data in other units
    const IdData data = with_relative_noise(oscillator(), 0.01, 1);
    const DmdcFit one = dmdc(data, {2, 3}), two = dmdc(scaled(data, 100, 0.01, 60), {2, 3});
    EXPECT_LT((one.fit.fit_percent - two.fit.fit_percent).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((one.singular_values - two.singular_values).cwiseAbs().maxCoeff(), 1e-9 * one.singular_values[0]);
}

}  // namespace test_learning_properties
