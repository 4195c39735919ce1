#include <gtest/gtest.h>

#include <cmath>

#include "numerics/criteria/process_output.h"
#include "numerics/signals/random.h"
#include "support/process_cases.h"

namespace test_process_output {

using namespace dynlab;
using namespace dynlab::test;

/// Sampled about once a second.
IdData some_data(Index N, bool regular) {
    Vector u = RandomStream(5).normal(N), t(N);
    for (Index k = 0; k < N; ++k) {
        u[k] = u[k - k % 9] + 0.4;
        t[k] = static_cast<double>(k) + 0.3 * std::sin(static_cast<double>(k));
    }
    const Matrix y = Vector::Zero(N);
    IdData data = regular ? IdData(y, Matrix(u), 1) : IdData(y, Matrix(u), t);
    data.hold = Hold::kFoh;
    return data;
}

TEST(process_output, coefficients_are_those_of_the_model) {  // oracle: second route, the transfer function
    for (const ProcessModel& model : every_process()) {
        const ProcessCoefficients c = process_coefficients(model.structure, model.parameters);
        const TransferFunction G = model.transfer_function();
        const std::string name = model.structure.text();
        ASSERT_EQ(c.den.size(), G.den().size()) << name;
        ASSERT_EQ(c.num.size(), G.num().size()) << name;
        EXPECT_LT((c.den - G.den()).cwiseAbs().maxCoeff(), 1e-12 * G.den().cwiseAbs().maxCoeff()) << name;
        EXPECT_LT((c.num - G.num()).cwiseAbs().maxCoeff(), 1e-12 * G.num().cwiseAbs().maxCoeff()) << name;
        EXPECT_EQ(c.delay, G.delay()) << name;
    }
}

TEST(process_output, derivatives_of_coefficients_agree_with_differences) {  // oracle: central differences
    for (const ProcessModel& model : every_process()) {
        const ProcessCoefficients c = process_coefficients(model.structure, model.parameters);
        for (Index i = 0; i < model.parameters.size(); ++i) {
            const Vector h = 1e-6 * Vector::Unit(model.parameters.size(), i);
            const ProcessCoefficients plus = process_coefficients(model.structure, model.parameters + h),
                                      minus = process_coefficients(model.structure, model.parameters - h);
            const Index n = c.den.size() - 1;
            EXPECT_LT((c.den_by_parameter.col(i) - (plus.den - minus.den).tail(n) / 2e-6).cwiseAbs().maxCoeff(), 1e-6)
                << model.structure.text() << " " << i;
            EXPECT_LT((c.num_by_parameter.col(i) - (plus.num - minus.num) / 2e-6).cwiseAbs().maxCoeff(), 1e-6)
                << model.structure.text() << " " << i;
        }
    }
}

TEST(process_output, sensitivities_agree_with_differences) {  // oracle: central differences
    for (const ProcessModel& model : every_process(4.0))
        for (const bool regular : {true, false})
            for (const bool estimate : {false, true}) {
                const IdData data = IdData::merge({some_data(60, regular), some_data(41, regular)});
                const TransferOutput transfer(transfer_structure(model.structure),
                                              {estimate ? InitialState::kEstimate : InitialState::kSteady, true}, data,
                                              0, 20, at_rest(model.structure));
                const Reparametrized output = process_output(model.structure, transfer);
                Vector theta = Vector::Constant(output.parameter_count(), 0.3), y, plus, minus;
                theta.head(model.parameters.size()) = model.parameters;
                Matrix sensitivities;
                output.simulate(theta, y, &sensitivities);
                for (Index i = 0; i < theta.size(); ++i) {
                    const Vector h = 1e-6 * Vector::Unit(theta.size(), i);
                    output.simulate(theta + h, plus, nullptr);
                    output.simulate(theta - h, minus, nullptr);
                    const Vector d = (plus - minus) / 2e-6;
                    EXPECT_LT((d - sensitivities.col(i)).cwiseAbs().maxCoeff(), 1e-5 * (1 + d.cwiseAbs().maxCoeff()))
                        << model.structure.text() << " " << i << " regular " << regular << " estimate " << estimate;
                }
            }
}

}  // namespace test_process_output
