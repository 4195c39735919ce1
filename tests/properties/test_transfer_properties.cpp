#include <gtest/gtest.h>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/lssvf.h"
#include "numerics/estimators/rivc.h"
#include "numerics/estimators/srivc.h"
#include "support/transfer_cases.h"

namespace test_transfer_properties {

using namespace dynlab;
using namespace dynlab::test;

using Method = std::function<Fit(const IdData&, const TransferStructure&, double time_scale)>;

FitOptions refined(double time_scale) {
    FitOptions options;
    options.lambda = 3 / time_scale;
    options.tolerance = 1e-10;
    return options;
}

SvfOptions filtered(double time_scale) {
    SvfOptions options;
    options.lambda = 3 / time_scale;
    return options;
}

SvfOptions moments(double time_scale) {  // as lsgpmf and ivgpmf
    SvfOptions options = filtered(time_scale);
    options.beta = 1.7 / time_scale;
    return options;
}

// As tfsrivc and tfcoe: default start, initial state and offset estimated.
FitOptions everything(double) {
    FitOptions options;
    options.initial_state = InitialState::kEstimate;
    options.offset = Offset::kEstimate;
    options.tolerance = 1e-10;
    return options;
}

const std::vector<std::pair<std::string, Method>> kMethods = {
    {"lssvf", [](const IdData& d, const TransferStructure& s, double scale) { return lssvf(d, s, filtered(scale)); }},
    {"ivsvf", [](const IdData& d, const TransferStructure& s, double scale) { return ivsvf(d, s, filtered(scale)); }},
    {"lsgpmf", [](const IdData& d, const TransferStructure& s, double scale) { return lssvf(d, s, moments(scale)); }},
    {"ivgpmf", [](const IdData& d, const TransferStructure& s, double scale) { return ivsvf(d, s, moments(scale)); }},
    {"srivc", [](const IdData& d, const TransferStructure& s, double scale) { return srivc(d, s, refined(scale)); }},
    {"tfsrivc",
     [](const IdData& d, const TransferStructure& s, double scale) { return srivc(d, s, everything(scale)); }},
    {"tfcoe", [](const IdData& d, const TransferStructure& s, double scale) { return coe(d, s, everything(scale)); }},
    {"coe", [](const IdData& d, const TransferStructure& s, double scale) { return coe(d, s, refined(scale)); }},
    // From here on for regular sampling only, because their noise models count in samples.
    {"rivc",
     [](const IdData& d, const TransferStructure& s, double scale) {
         return rivc(d, s, {1, 1}, refined(scale));
     }},
    {"tfrivc",
     [](const IdData& d, const TransferStructure& s, double scale) {
         return rivc(d, s, {0, 1}, everything(scale));
     }},
};
constexpr std::size_t kForRegularSampling = 2;  // the last ones

class transfer_properties : public testing::TestWithParam<std::size_t> {
  protected:
    Fit estimate(const IdData& data, double time_scale = 1, double delay = 0) const {
        return kMethods[GetParam()].second(data, TransferStructure::single(2, 0, delay), time_scale);
    }
    const IdData data_ = course_system_data(0.2, 21);
    const Matrix &y_ = data_.experiments[0].y, &u_ = data_.experiments[0].u;
};

class irregular_transfer_properties : public transfer_properties {};

TEST_P(transfer_properties, slower_time_scales_the_coefficients) {  // oracle: invariance
    const Fit one = estimate(data_);
    for (const double scale : {1e-6, 1e-3, 60.0, 3600.0}) {
        const Fit slow = estimate(IdData(y_, u_, 0.01 * scale), scale);
        const Vector factor = values({1 / scale, 1 / scale / scale, 1 / scale / scale});
        EXPECT_LT(relative_difference(slow.theta, one.theta.cwiseProduct(factor)), 1e-7) << scale;
        EXPECT_LT(relative_difference(slow.std, one.std.cwiseProduct(factor)), 1e-6) << scale;
    }
}

TEST_P(transfer_properties, input_and_output_units_scale_the_numerator) {  // oracle: invariance
    const Fit one = estimate(data_);
    for (const auto& [of_y, of_u] : {std::pair{1e4, 1e-3}, std::pair{-1e-6, 1e6}, std::pair{1e6, 1.0}}) {
        const Fit scaled = estimate(IdData(of_y * y_, of_u * u_, 0.01));
        const Vector factor = values({1, 1, of_y / of_u});
        EXPECT_LT(relative_difference(scaled.theta, one.theta.cwiseProduct(factor)), 1e-7) << of_y;
        EXPECT_LT(relative_difference(scaled.std, one.std.cwiseProduct(factor.cwiseAbs())), 1e-6) << of_y;
    }
}

TEST_P(irregular_transfer_properties, irregular_records_may_begin_at_any_time) {  // oracle: invariance
    const Index N = 400;
    const Vector jitter = RandomStream(6).uniform(N);
    Vector t(N);
    for (Index k = 0; k < N; ++k) t[k] = 0.04 * (static_cast<double>(k) + 0.5 * jitter[k]);
    const Matrix u = prbs(5, 13, -1, 1).head(N);
    const Vector x = lsim(TransferFunction(values({2}), values({1, 4, 3})), u.col(0), t);
    const Matrix y = x + 0.1 * RandomStream(7).normal(N);
    const Vector one = estimate(IdData(y, u, t)).theta, late = estimate(IdData(y, u, Vector(t.array() + 64))).theta,
                 slow = estimate(IdData(y, u, Vector(60 * t)), 60).theta;
    EXPECT_LT(relative_difference(late, one), 1e-7);
    EXPECT_LT(relative_difference(slow, values({one[0] / 60, one[1] / 3600, one[2] / 3600})), 1e-7);
}

// Oracle: invariance. With an estimated start the samples count to which all inputs are known.
TEST_P(transfer_properties, delays_of_whole_samples_equal_shifted_inputs) {
    const InitialState start = estimate(data_).start.state;
    Matrix late = Matrix::Constant(u_.rows(), 1, start == InitialState::kZero ? 0 : u_(0, 0));
    late.bottomRows(u_.rows() - 9) = u_.topRows(u_.rows() - 9);
    const IdData shifted(y_, late, 0.01);
    const bool leaves_out = start == InitialState::kEstimate;
    const Vector a = estimate(leaves_out ? shifted.range(11, u_.rows()) : shifted).theta,
                 b = estimate(data_, 1, 0.09).theta;
    EXPECT_LT(relative_difference(a, b), 1e-7);
}

TEST_P(transfer_properties, order_of_experiments_does_not_matter) {  // oracle: invariance
    const IdData other = course_system_data(0.3, 22);
    const Vector a = estimate(IdData::merge({data_, other})).theta, b = estimate(IdData::merge({other, data_})).theta;
    EXPECT_LT(relative_difference(a, b), 1e-7);
}

std::string name_of(const testing::TestParamInfo<std::size_t>& instance) {
    return kMethods[instance.param].first;
}
INSTANTIATE_TEST_SUITE_P(methods, transfer_properties, testing::Range<std::size_t>(0, kMethods.size()), name_of);
INSTANTIATE_TEST_SUITE_P(methods, irregular_transfer_properties,
                         testing::Range<std::size_t>(0, kMethods.size() - kForRegularSampling), name_of);

}  // namespace test_transfer_properties
