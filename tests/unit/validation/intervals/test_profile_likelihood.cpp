#include "numerics/validation/intervals/profile_likelihood.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/reader.h"
#include "numerics/signals/prbs.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "numerics/statistics/distributions.h"
#include "support/thrown_message.h"

namespace test_profile_likelihood {

using namespace dynlab;
using testing::HasSubstr;

IdData simulated_data(double noise, double delay, std::uint32_t seed = 1) {
    const Vector u = prbs(5, 6);
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 1.5}}, 0, delay);
    return IdData(Matrix(lsim(G, u, 0.1) + noise * RandomStream(seed).normal(u.size())), Matrix(u), 0.1);
}

TransferStructure delayed() {
    TransferStructure structure = TransferStructure::single(1, 0);
    structure.free_delays = true;
    return structure;
}

TEST(profile_likelihood, rises_as_the_refitted_loss) {  // oracle: a fine search over the other parameter
    const IdData data = simulated_data(0.2, 0);
    const RefittedOutput model(data, {TransferStructure::single(1, 0), {}, Vector{{1.5, 2}}});
    const Profile found = profile_likelihood(model, "a1");
    const Vector y = data.experiments[0].y.col(0), u = data.experiments[0].u.col(0);
    const auto loss = [&](double a1) {  // b0 by linear regression
        const Vector x = lsim(TransferFunction(Vector{{1.0}}, Vector{{1.0, a1}}), u, 0.1);
        return (y - x * (x.dot(y) / x.squaredNorm())).squaredNorm();
    };
    const double least = loss(found.estimate), N = static_cast<double>(y.size());
    for (Index i = 0; i < found.grid.size(); i += 5)
        EXPECT_NEAR(found.rise[i], N * std::log(loss(found.grid[i]) / least), 1e-3) << found.grid[i];
    ASSERT_TRUE(found.low && found.high);
    EXPECT_NEAR(N * std::log(loss(*found.low) / least), chi_squared_quantile(0.95, 1), 0.01);
    EXPECT_NEAR(N * std::log(loss(*found.high) / least), chi_squared_quantile(0.95, 1), 0.01);
    EXPECT_NEAR((*found.high - *found.low) / (2 * 1.96 * found.std), 1, 0.1);
}

TEST(profile_likelihood, of_a_delay_has_the_samples_on_its_grid) {  // oracle: multiples of 0.1 s
    const RefittedOutput model(simulated_data(0.5, 0.33), {delayed(), {}, Vector{{1.5, 2, 0.33}}});
    const Profile found = profile_likelihood(model, "Td");
    ASSERT_TRUE(found.low && found.high);
    EXPECT_LT(*found.low, 0.33);
    EXPECT_GT(*found.high, 0.33);
    for (double k = std::ceil(found.grid[0] / 0.1); k * 0.1 <= found.grid[found.grid.size() - 1]; ++k)
        EXPECT_LT((found.grid.array() - 0.1 * k).abs().minCoeff(), 1e-9);
}

TEST(profile_likelihood,
     reports_where_it_has_no_end) {  // oracle: two steps too early to separate a time constant from a ramp
    const Vector u = Vector::Ones(40);
    const TransferFunction G(Vector{{0.02}}, Vector{{1.0, 0.02}});
    const Vector y = lsim(G, u, 0.1) + 0.02 * RandomStream(2).normal(40);
    const RefittedOutput model(IdData(Matrix(y), Matrix(u), 0.1), {{}, ProcessStructure::parse("P1"), Vector{{1, 50}}});
    const Profile found = profile_likelihood(model, "Tp1");
    EXPECT_FALSE(found.high.has_value());
    EXPECT_THAT(message_text(found.message), HasSubstr("without an upper limit"));
}

TEST(profile_likelihood, can_be_stopped) {
    const RefittedOutput model(simulated_data(0.5, 0.33), {delayed(), {}, Vector{{1.5, 2, 0.33}}});
    ProfileOptions options;
    int asked = 0;
    options.cancel = [&] { return ++asked > 5; };
    EXPECT_TRUE(profile_likelihood(model, "Td", options).canceled);
}

TEST(profile_likelihood, says_what_it_needs) {
    const RefittedOutput model(simulated_data(0.5, 0), {TransferStructure::single(1, 0), {}, Vector{{1.5, 2}}});
    EXPECT_THAT(thrown_message([&] { profile_likelihood(model, "Td"); }), HasSubstr("no estimated parameter 'Td'"));
    ProfileOptions options;
    options.points = 2;
    EXPECT_THAT(thrown_message([&] { profile_likelihood(model, "a1", options); }), HasSubstr("`points`"));
    options = {};
    options.range = {{2, 1}};
    EXPECT_THAT(thrown_message([&] { profile_likelihood(model, "a1", options); }), HasSubstr("`range`"));
    options.range = {{50, 60}};
    EXPECT_THAT(thrown_message([&] { profile_likelihood(model, "a1", options); }),
                HasSubstr("must contain the estimate"));
    options = {};
    options.confidence = 0;
    EXPECT_THAT(thrown_message([&] { profile_likelihood(model, "a1", options); }), HasSubstr("`confidence`"));
}

}  // namespace test_profile_likelihood
