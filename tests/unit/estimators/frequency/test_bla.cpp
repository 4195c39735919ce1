#include "numerics/estimators/frequency/bla.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/signals/random_phase_multisine.h"
#include "numerics/simulation/lsim.h"
#include "numerics/simulation/sampled_response.h"
#include "support/message_texts.h"
#include "support/thrown_message.h"

namespace test_bla {

using namespace dynlab;
using dynlab::test::texts_of;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Index kPeriod = 512;
constexpr double kTs = 0.05;
const TransferFunction kPlant(Vector{{2.0}}, Vector{{1.0, 1.2, 4.0}});

struct Measurement {
    Index realizations = 4, periods = 3, settling = 4;
    double noise = 0, square = 0, cube = 0;
    bool odd = false;
};

/// Realizations behind one another, each after periods that are not recorded; the nonlinearity acts on the output.
IdData measured_data(const Measurement& how) {
    RandomStream random(5);
    RandomPhaseOptions options;
    options.lines = Vector::LinSpaced(100, 1, 100);
    options.odd = how.odd;
    const Index length = how.periods * kPeriod;
    Vector u(how.realizations * length), y(u.size());
    for (Index m = 0; m < how.realizations; ++m) {
        const Vector one = random_phase_multisine(kPeriod, options, random).u;
        const Vector input = one.replicate(how.settling + how.periods, 1);
        const Vector x = lsim(kPlant, input, kTs).tail(length);
        u.segment(m * length, length) = input.tail(length);
        y.segment(m * length, length) = x.array() + how.square * x.array().square() + how.cube * x.array().cube() +
                                        how.noise * random.normal(length).array();
    }
    return IdData(Matrix(y), Matrix(u), kTs);
}

BlaOptions options_of(const Measurement& how) {
    BlaOptions options;
    options.period = kPeriod;
    options.realizations = how.realizations;
    return options;
}

double largest_error(const FrequencyData& found) {
    const ComplexVector truth = response_between_samples(kPlant, found.w, kTs, InterSample::kZoh);
    return ((found.response - truth).cwiseAbs().cwiseQuotient(truth.cwiseAbs())).maxCoeff();
}

TEST(bla, of_a_linear_system_without_noise_is_its_response) {  // oracle: the sampled system
    Measurement how;
    how.settling = 10;
    const FrequencyData found = bla(measured_data(how), options_of(how));
    ASSERT_EQ(found.w.size(), 100);
    EXPECT_NEAR(found.w[0], 2 * std::numbers::pi / (kPeriod * kTs), 1e-12);
    EXPECT_LT(largest_error(found), 1e-9);
    EXPECT_EQ(found.inter_sample, InterSample::kZoh);
    EXPECT_THAT(found.warnings, IsEmpty());
    EXPECT_LT(level_sums(found).distortion, 1e-18 * level_sums(found).power);
}

TEST(bla, averages_are_those_of_their_definition) {  // second route: transforms summed sample by sample
    Measurement how;
    how.noise = 0.1, how.cube = 0.2;
    const IdData data = measured_data(how);
    BlaOptions options = options_of(how);
    options.smooth = 0;
    const FrequencyData found = bla(data, options);
    const Index line = 7, M = 4, P = 3;
    const Vector u = data.experiments[0].u.col(0), y = data.experiments[0].y.col(0);
    ComplexVector G(M);
    double noise = 0;
    for (Index m = 0; m < M; ++m) {
        ComplexVector U = ComplexVector::Zero(P), Y = ComplexVector::Zero(P);
        for (Index p = 0; p < P; ++p)
            for (Index n = 0; n < kPeriod; ++n) {
                const Complex turn = std::polar(1.0, -2 * std::numbers::pi * line * n / kPeriod);
                U[p] += u[(m * P + p) * kPeriod + n] * turn, Y[p] += y[(m * P + p) * kPeriod + n] * turn;
            }
        G[m] = Y.mean() / U.mean();
        noise += (Y.array() - Y.mean()).abs2().sum() / (P - 1) / P / std::norm(U.mean()) / M;  // the input has no noise
    }
    const double spread = (G.array() - G.mean()).abs2().sum() / (M - 1);
    EXPECT_LT(std::abs(found.response[line - 1] - G.mean()), 1e-12);
    EXPECT_NEAR(found.variance[line - 1], spread / M, 1e-9 * spread);
    EXPECT_NEAR(found.noise_variance[line - 1], noise / M, 1e-9 * noise);
    EXPECT_NEAR(found.distortion[line - 1], std::max(0.0, spread - noise), 1e-9 * spread);
}

TEST(bla, experiments_are_realizations_too) {  // second route: the same data in pieces
    Measurement how;
    how.noise = 0.1;
    const IdData joined = measured_data(how);
    std::vector<IdData> parts;
    for (Index m = 0; m < 4; ++m) parts.push_back(joined.range(3 * kPeriod * m + 1, 3 * kPeriod * (m + 1)));
    BlaOptions options = options_of(how);
    const FrequencyData one = bla(joined, options);
    options.realizations = 1;
    const FrequencyData other = bla(IdData::merge(parts), options);
    EXPECT_LT((one.response - other.response).norm(), 1e-13 * one.response.norm());
    EXPECT_LT((one.variance - other.variance).norm(), 1e-12 * one.variance.norm());
}

TEST(bla, powers_show_at_lines_of_their_kind) {  // oracle: even powers of odd lines lie at even lines
    Measurement how;
    how.odd = true, how.settling = 10;
    how.square = 0.3;
    const FrequencyData even = bla(measured_data(how), options_of(how));
    EXPECT_GT(even.even.distortion.sum(), 1e4 * std::abs(even.odd.distortion.sum()));
    how.square = 0, how.cube = 0.3;
    const FrequencyData odd = bla(measured_data(how), options_of(how));
    EXPECT_GT(odd.odd.distortion.sum(), 1e4 * std::abs(odd.even.distortion.sum()));
}

TEST(bla, levels_sum_up_to_the_output) {  // oracle: Parseval; no line at zero or at half the sampling frequency matters
    Measurement how;
    how.noise = 0.05, how.cube = 0.1;
    const IdData data = measured_data(how);
    const FrequencyData found = bla(data, options_of(how));
    const LevelSums sums = level_sums(found);
    Vector mean_periods(4 * kPeriod);
    for (Index m = 0; m < 4; ++m)
        mean_periods.segment(m * kPeriod, kPeriod) =
            data.experiments[0].y.col(0).segment(3 * m * kPeriod, 3 * kPeriod).reshaped(kPeriod, 3).rowwise().mean();
    const double power = mean_periods.squaredNorm() / (4 * kPeriod);
    EXPECT_NEAR(sums.power, power, 1e-3 * power);
    EXPECT_NEAR(sums.noise, 0.05 * 0.05 / 3, 0.1 * 0.05 * 0.05 / 3);
    EXPECT_THAT(message_text(found.message), HasSubstr("dB relative to the output, averaged over 3 periods."));
}

TEST(bla, reports_what_is_wrong_with_a_record) {
    Measurement how;
    how.settling = 0, how.noise = 0.001;
    EXPECT_THAT(texts_of(bla(measured_data(how), options_of(how)).warnings), Contains(HasSubstr("`transient` = 1")));
    BlaOptions dropped = options_of(how);
    dropped.transient = 1;
    EXPECT_THAT(texts_of(bla(measured_data(how), dropped).warnings), testing::Not(Contains(HasSubstr("`transient`"))));

    how = {};
    const IdData whole = measured_data(how);
    BlaOptions one = options_of(how);
    one.realizations = 1;
    const FrequencyData cut = bla(whole.range(101, 3 * kPeriod), one);
    EXPECT_THAT(texts_of(cut.warnings), Contains(HasSubstr("bla omits the first 412 samples")));
    EXPECT_THAT(texts_of(cut.warnings), Contains(HasSubstr("With only one realization")));
    EXPECT_LT(largest_error(cut), 1e-2);
    EXPECT_EQ(cut.distortion.size(), 0);
    const FrequencyData single = bla(whole.range(1, kPeriod), one);
    EXPECT_THAT(texts_of(single.warnings), Contains(HasSubstr("With only one period")));
    EXPECT_EQ(single.variance.size(), 0);

    Matrix u = whole.experiments[0].u;
    RandomStream random(2);
    u.col(0) += 0.25 * random.normal(u.rows());
    EXPECT_THAT(texts_of(bla(IdData(whole.experiments[0].y, u, kTs), options_of(how)).warnings),
                Contains(HasSubstr("is only approximately periodic")));
}

TEST(bla, refuses_what_it_cannot_use) {
    Measurement how;
    const IdData data = measured_data(how);
    const auto refusal = [&](const BlaOptions& options) { return thrown_message([&] { bla(data, options); }); };
    BlaOptions options;
    EXPECT_THAT(refusal(options), HasSubstr("the period must be"));
    options.period = 500;
    EXPECT_THAT(refusal(options), HasSubstr("is not periodic with a period of 500 samples"));
    options.period = 10000;
    EXPECT_THAT(refusal(options), HasSubstr("longer than a realization of 6144"));
    options = options_of(how);
    options.realizations = 5;
    EXPECT_THAT(refusal(options), HasSubstr("the number of realizations, 5, must divide the number of samples, 6144"));
    options.realizations = 4, options.transient = 3;
    EXPECT_THAT(refusal(options), HasSubstr("no data remain after 3 of 3 periods are omitted"));
    options.transient = 0, options.least_input = 1;
    EXPECT_THAT(refusal(options), HasSubstr("between 0 and 1"));
}

// Oracle: a system without memory answers each repetition alike, whatever it does to the input.
TEST(bla, refuses_realizations_of_one_input) {
    Measurement how;
    how.realizations = 1, how.periods = 12, how.cube = 0.3, how.noise = 0.02;
    const IdData repeated = measured_data(how);
    BlaOptions options = options_of(how);
    options.realizations = 4;
    EXPECT_THAT(thrown_message([&] { bla(repeated, options); }), HasSubstr("realizations 1 and 2 have the same input"));
    options.realizations = 1;
    EXPECT_EQ(bla(repeated, options).distortion.size(), 0);

    const IdData shifted = IdData::merge({repeated.range(1, 3 * kPeriod), repeated.range(101, 3 * kPeriod + 100)});
    EXPECT_THAT(thrown_message([&] { bla(shifted, options); }), HasSubstr("have the same input"));
    how.realizations = 3, how.periods = 3;
    const IdData others = measured_data(how),
                 merged = IdData::merge({others.range(1, 3 * kPeriod), others.range(1 + 3 * kPeriod, 6 * kPeriod),
                                         others.range(1, 3 * kPeriod)});
    EXPECT_THAT(thrown_message([&] { bla(merged, options); }), HasSubstr("realizations 1 and 3"));
}

}  // namespace test_bla
