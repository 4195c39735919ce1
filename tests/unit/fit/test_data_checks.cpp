#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/fit/diagnosis.h"
#include "support/thrown_message.h"
#include "support/transfer_cases.h"

namespace test_data_checks {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;

const TransferStructure kSecond = TransferStructure::single(2, 0);

IdData with_signals(const IdData& data, const Matrix& y, const Matrix& u) {
    return IdData(y, u, data.Ts);
}

TEST(data_checks, of_transfer_functions) {  // oracle: the promises of the header
    const IdData data = course_system_data(0.1, 1);
    const Matrix &y = data.experiments[0].y, &u = data.experiments[0].u;
    const auto refusal = [](const IdData& given, const TransferStructure& structure) {
        return thrown_message([&] { check_transfer_data("method", given, structure); });
    };
    EXPECT_EQ(refusal(data, kSecond), "");
    EXPECT_THAT(refusal(with_signals(data, y, 0 * u), kSecond),
                HasSubstr("method: the input u1 is zero in all samples"));
    EXPECT_THAT(refusal(with_signals(data, Matrix::Ones(y.rows(), 1), u), kSecond), HasSubstr("output never changes"));
    EXPECT_THAT(refusal(with_signals(data, y, Matrix(y.rows(), 0)), kSecond), HasSubstr("no input"));
    EXPECT_THAT(refusal(data.range(1, 8), kSecond), HasSubstr("at least 9 samples are needed for 3 parameters"));
    EXPECT_THAT(refusal(data, TransferStructure::single(2, 0, 20)), HasSubstr("the delay of 20 s is not shorter"));
    Matrix two(u.rows(), 2);
    two << u, u;
    EXPECT_THAT(refusal(with_signals(data, y, two), kSecond), HasSubstr("the model has 1 input and 1 output"));
    const Matrix running = y.array() + 5;
    EXPECT_THAT(refusal(with_signals(data, running, Matrix::Ones(u.rows(), 1)), kSecond), HasSubstr("no excitation"));
    EXPECT_EQ(refusal(with_signals(data, y, Matrix::Ones(u.rows(), 1)), kSecond), "") << "a step at the first sample";
    two.col(1).setConstant(20);
    const TransferStructure both = TransferStructure::grid(1, 2, Denominators::kPerOutput, {2}, {0}, {0});
    IdData resting(running, two, data.Ts);
    resting.input_names = {"Q1", "Q2"};
    EXPECT_THAT(thrown_message([&] { check_transfer_data("method", resting, both, Offset::kEstimate); }),
                HasSubstr("the input Q2 never changes"));
}

TEST(data_checks, of_numbers_of_samples) {  // oracle: the definition
    EXPECT_EQ(thrown_message([] { check_sample_count("method", 5, 4); }), "");
    EXPECT_THAT(thrown_message([] { check_sample_count("method", 4, 4); }),
                HasSubstr("method estimates 4 values and needs more samples than that, but the data have 4"));
}

TEST(data_checks, a_constant_input_teaches_through_a_transient_only) {  // oracle: an explained and a missed transient
    const Vector ones = Vector::Ones(400), y = lsim(TransferFunction(values({1}), values({1, 1})), ones, 0.05);
    const IdData data(Matrix(y), Matrix(ones), 0.05);
    Fit fit;
    fit.loss = 1e-6;
    EXPECT_EQ(thrown_message([&] { check_transient("method", data, fit, 2); }), "");
    fit.loss = (y.array() - y.mean()).square().mean();
    EXPECT_THAT(thrown_message([&] { check_transient("method", data, fit, 2); }),
                HasSubstr("method: the input never changes"));
    fit.termination = Termination::kCanceled;
    EXPECT_EQ(thrown_message([&] { check_transient("method", data, fit, 2); }), "");
}

TEST(data_checks, where_delays_are_looked_for) {  // oracle: the definition
    const IdData data = course_system_data(0, 1), both = IdData::merge({data, data.range(1, 401)});
    EXPECT_DOUBLE_EQ(shortest_experiment(both), 4);
    FitOptions options;
    options.least_delay = 0.1;
    EXPECT_DOUBLE_EQ(delay_range(both, options).largest, 1);
    EXPECT_DOUBLE_EQ(delay_range(both, options).least, 0.1);
    options.largest_delay = 3;
    EXPECT_DOUBLE_EQ(delay_range(both, options).largest, 3);
    options.largest_delay = 4;
    EXPECT_THAT(thrown_message([&] { delay_range(both, options); }), HasSubstr("`largest_delay` must be shorter"));
}

}  // namespace test_data_checks
