#include <gtest/gtest.h>

#include "base/reader.h"
#include "numerics/estimators/procsrivc.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "support/process_cases.h"
#include "support/transfer_cases.h"

namespace test_process_properties {

using namespace dynlab;
using namespace dynlab::test;

constexpr double kTs = 0.1;

Vector levels(Index N) {
    const Vector noise = RandomStream(5).normal(N);
    Vector u(N);
    for (Index k = 0; k < N; ++k) u[k] = noise[k / 8] > 0 ? 1 : -1;
    return u;
}

ProcsrivcOptions tight() {
    ProcsrivcOptions options;
    options.tolerance = 1e-11;
    return options;
}

ProcsrivcOptions from_rest() {
    ProcsrivcOptions options = tight();
    options.initial_state = InitialState::kZero;
    options.offset = Offset::kNone;
    return options;
}

ProcessModel model_of(const std::string& structure) {
    for (const ProcessModel& model : every_process())
        if (model.structure.text() == structure) return model;
    throw std::logic_error("no such structure");
}

IdData simulated_data(const ProcessModel& model, std::uint32_t seed) {
    const Vector u = levels(500);
    const Vector x = lsim(model.transfer_function(), u, kTs);
    return IdData(Matrix(x + 0.02 * RandomStream(seed).normal(500)), Matrix(u), kTs);
}

// By how much each parameter grows when times grow by `time` and the gain by `gain`.
Vector growth(const ProcessStructure& structure, double time, double gain) {
    const auto names = structure.parameter_names();
    Vector factor = Vector::Ones(static_cast<Index>(names.size()));
    for (Index i = 0; i < factor.size(); ++i)
        if (names[static_cast<std::size_t>(i)].front() == 'T') factor[i] = time;
    factor[0] = structure.integrator ? gain / time : gain;
    return factor;
}

void expect_grown(const Fit& grown, const Fit& one, const Vector& factor) {
    EXPECT_LT(relative_difference(grown.theta, one.theta.cwiseProduct(factor)), 1e-7)
        << message_text(grown.full_message());
    EXPECT_LT(relative_difference(grown.std, one.std.cwiseProduct(factor.cwiseAbs())), 1e-6);
    EXPECT_EQ(grown.start.state, one.start.state);
    EXPECT_EQ(grown.start.offset, one.start.offset);
    EXPECT_NEAR(grown.fit_percent[0], one.fit_percent[0], 1e-7);
}

class process_properties : public testing::TestWithParam<const char*> {
  protected:
    const ProcessModel model_ = model_of(GetParam());
    const ProcessStructure& structure_ = model_.structure;
    const IdData data_ = simulated_data(model_, 21);
    const Matrix &y_ = data_.experiments[0].y, &u_ = data_.experiments[0].u;
};

TEST_P(process_properties, the_unit_of_time_scales_times) {  // oracle: invariance
    const auto one = procsrivc(data_, structure_, tight());
    for (const double scale : {1e-6, 3600.0})
        expect_grown(procsrivc(IdData(y_, u_, kTs * scale), structure_, tight()), one, growth(structure_, scale, 1));
}

TEST_P(process_properties, units_of_input_and_output_scale_the_gain) {  // oracle: invariance
    const auto one = procsrivc(data_, structure_, tight());
    for (const auto& [of_y, of_u] : {std::pair{1e4, 1e-3}, std::pair{-1e-6, 1e6}})
        expect_grown(procsrivc(IdData(of_y * y_, of_u * u_, kTs), structure_, tight()), one,
                     growth(structure_, 1, of_y / of_u));
}

TEST_P(process_properties, order_of_experiments_does_not_matter) {  // oracle: invariance
    const IdData other = simulated_data(model_, 22).range(1, 400);
    const auto a = procsrivc(IdData::merge({data_, other}), structure_, tight()),
               b = procsrivc(IdData::merge({other, data_}), structure_, tight());
    expect_grown(a, b, growth(structure_, 1, 1));
    EXPECT_EQ(a.offsets.size(), 2);
    EXPECT_LT((a.offsets - b.offsets.reverse()).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(process_properties, an_earlier_input_is_a_longer_delay) {  // oracle: invariance, from rest
    const Index shift = 3;
    Matrix late = Matrix::Zero(500, 1);
    late.bottomRows(500 - shift) = u_.topRows(500 - shift);
    ProcsrivcOptions known = from_rest();
    if (!structure_.delay) {
        ProcessStructure delayed = structure_;
        delayed.delay = true;
        known.least_delay = known.largest_delay.emplace(static_cast<double>(shift) * kTs);
        const auto a = procsrivc(data_, delayed, known), b = procsrivc(IdData(y_, late, kTs), structure_, from_rest());
        EXPECT_LT(relative_difference(a.theta.head(b.theta.size()), b.theta), 1e-7);
        return;
    }
    const auto a = procsrivc(data_, structure_, known), b = procsrivc(IdData(y_, late, kTs), structure_, known);
    const Index last = a.theta.size() - 1;
    EXPECT_NEAR(a.theta[last], b.theta[last] + static_cast<double>(shift) * kTs, 1e-8);
    EXPECT_LT(relative_difference(a.theta.head(last), b.theta.head(last)), 1e-7);
    EXPECT_LT(relative_difference(a.std, b.std), 1e-6);
}

TEST_P(process_properties, irregular_records_may_begin_at_any_time) {  // oracle: invariance
    const Index N = 200;
    const Vector jitter = RandomStream(6).uniform(N), u = levels(N);
    Vector t(N);
    for (Index k = 0; k < N; ++k) t[k] = kTs * (static_cast<double>(k) + 0.5 * jitter[k]);
    const Matrix y = lsim(model_.transfer_function(), u, t) + 0.02 * RandomStream(7).normal(N);
    const auto at = [&](const Vector& instants) {
        return procsrivc(IdData(y, Matrix(u), instants), structure_, from_rest());
    };
    const auto one = at(t);
    expect_grown(at(t.array() + 64), one, growth(structure_, 1, 1));
    expect_grown(at(60 * t), one, growth(structure_, 60, 1));
}

INSTANTIATE_TEST_SUITE_P(structures, process_properties,
                         testing::Values("P1", "P2", "P3", "P2U", "P1D", "P2DU", "P1I", "P2Z", "P3ZU", "P1DI"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace test_process_properties
