#include <gtest/gtest.h>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/srivc.h"
#include "support/transfer_cases.h"

using namespace dynlab;
using namespace dynlab::test;

namespace {

using Method = std::function<TransferEstimate(const IdData&, const TransferStructure&, double time_scale)>;

TransferOptions refined(double time_scale) {
    TransferOptions options;
    options.lambda = 3 / time_scale;
    options.Tol = 1e-10;
    return options;
}

SvfOptions filtered(double time_scale) {
    SvfOptions options;
    options.lambda = 3 / time_scale;
    return options;
}

const std::vector<std::pair<std::string, Method>> kMethods = {
    {"lssvf", [](const IdData& d, const TransferStructure& s, double scale) { return lssvf(d, s, filtered(scale)); }},
    {"ivsvf", [](const IdData& d, const TransferStructure& s, double scale) { return ivsvf(d, s, filtered(scale)); }},
    {"srivc", [](const IdData& d, const TransferStructure& s, double scale) { return srivc(d, s, refined(scale)); }},
    {"coe", [](const IdData& d, const TransferStructure& s, double scale) { return coe(d, s, refined(scale)); }},
};

}  // namespace

class transfer_properties : public testing::TestWithParam<std::size_t> {
  protected:
    TransferEstimate estimate(const IdData& data, double time_scale = 1, double delay = 0) const {
        return kMethods[GetParam()].second(data, TransferStructure::single(2, 0, delay), time_scale);
    }
    const IdData data_ = course_record(0.2, 21);
    const Matrix &y_ = data_.experiments[0].y, &u_ = data_.experiments[0].u;
};

TEST_P(transfer_properties, slower_time_scales_the_coefficients) {  // oracle: invariance
    const Vector one = estimate(data_).theta;
    for (const double scale : {1e-3, 60.0, 3600.0}) {
        const Vector slow = estimate(IdData(y_, u_, 0.01 * scale), scale).theta;
        EXPECT_LT(relative_difference(slow, values({one[0] / scale, one[1] / scale / scale, one[2] / scale / scale})),
                  1e-7)
            << scale;
    }
}

TEST_P(transfer_properties, input_and_output_units_scale_the_numerator) {  // oracle: invariance
    const Vector one = estimate(data_).theta;
    const Vector scaled = estimate(IdData(1e4 * y_, 1e-3 * u_, 0.01)).theta;
    EXPECT_LT(relative_difference(scaled, values({one[0], one[1], 1e7 * one[2]})), 1e-7);
}

TEST_P(transfer_properties, delays_of_whole_samples_equal_shifted_inputs) {  // oracle: invariance
    Matrix late = Matrix::Zero(u_.rows(), 1);
    late.bottomRows(u_.rows() - 9) = u_.topRows(u_.rows() - 9);
    const Vector a = estimate(IdData(y_, late, 0.01)).theta, b = estimate(data_, 1, 0.09).theta;
    EXPECT_LT(relative_difference(a, b), 1e-7);
}

TEST_P(transfer_properties, order_of_experiments_does_not_matter) {  // oracle: invariance
    const IdData other = course_record(0.3, 22);
    const Vector a = estimate(IdData::merge({data_, other})).theta, b = estimate(IdData::merge({other, data_})).theta;
    EXPECT_LT(relative_difference(a, b), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(methods, transfer_properties, testing::Range<std::size_t>(0, kMethods.size()),
                         [](const auto& instance) { return kMethods[instance.param].first; });
