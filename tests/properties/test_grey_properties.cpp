#include <gtest/gtest.h>

#include "numerics/estimators/grey_box/greyest.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "support/grey_cases.h"
#include "support/transfer_cases.h"

namespace test_grey_properties {

using namespace dynlab;
using namespace dynlab::test;

constexpr double kTs = 0.05;

/// A pendulum that swings far, its angle in units of 1/angle rad, time in units of 1/time s, the torque in 1/torque N
/// m.
GreyModel scaled_pendulum(double time, double angle, double torque) {
    const double w0 = 8 / (time * time), gain = 2.5 * angle / (time * time * torque), friction = 0.5 / time;
    return grey_model(
        {{"a", w0}, {"b", gain}, {"c", friction}}, {"phi", "w"},
        [angle](const Variables& v) -> std::vector<Term> {
            return {v.x[1], -(angle * (v.p[0] * sine((1 / angle) * v.x[0]))) - v.p[2] * v.x[1] + v.p[1] * v.u};
        },
        [](const Variables& v) -> std::vector<Term> { return {v.x[0]}; });
}

GreyFit fit(double time, double angle, double torque) {
    const Vector u = prbs(5, 6), t = kTs * Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1));
    const Matrix y =
        GreySimulator(scaled_pendulum(1, 1, 1), 1, {}, 1e-10).run(Vector{{9, 3, 0.4}}, {Matrix(u), t}, {}, false).y;
    const Vector noisy = y.col(0) + 0.05 * RandomStream(7).normal(u.size());
    const IdData data(Matrix(angle * noisy), Matrix(torque * u), time * kTs);
    GreyOptions options;
    options.tolerance = 1e-10;
    return greyest(data, scaled_pendulum(time, angle, torque), options);
}

// Oracle: invariance. Units of time, angle and torque go into parameters and errors, and nowhere else.
TEST(grey_properties, units_have_no_say) {
    const GreyFit one = fit(1, 1, 1);
    for (const auto& [time, angle, torque] :
         {std::tuple(1e3, 1., 1.), std::tuple(1., 1e4, 1.), std::tuple(1., 1., 1e-5), std::tuple(1e-6, 57., 3e4)}) {
        const GreyFit other = fit(time, angle, torque);
        const Vector units{{1 / (time * time), angle / (time * time * torque), 1 / time}};
        EXPECT_LT(relative_difference(other.fit.theta.cwiseQuotient(units), one.fit.theta), 1e-7);
        EXPECT_LT(relative_difference(other.fit.std.cwiseQuotient(units), one.fit.std), 1e-6);
        EXPECT_NEAR(other.fit.fit_percent[0], one.fit.fit_percent[0], 1e-7);
    }
}

// Oracle: invariance. For an equation without time, data that begin later are the same data.
TEST(grey_properties, when_a_record_begins_has_no_say) {
    IdData data = course_system_data(0.2, 3);
    const GreyModel model = first_order(1, 1);
    const GreyFit one = greyest(data, model);
    data.experiments[0].start_time = 1000;
    const GreyFit later = greyest(data, model);
    EXPECT_LT(relative_difference(later.fit.theta, one.fit.theta), 1e-7);
}

}  // namespace test_grey_properties
