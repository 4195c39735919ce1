// Oracle: the sums of products that LSSVF and IVSVF solve, made without storing a signal: sum z e = z_y - z_phi theta.
#include "numerics/criteria/estimating_terms.h"

#include <gtest/gtest.h>

#include "numerics/filters/filter_chain.h"
#include "numerics/filters/normal_equations.h"
#include "support/transfer_cases.h"

namespace test_estimating_terms {

using namespace dynlab;
using namespace dynlab::test;

/// Two inputs, the second late by a part of a sample and with a zero more.
struct TwoInputs {
    IdData data = course_system_data(0.2, 3);
    Vector second = RandomStream(7).normal(data.sample_count());
    Vector E = values({1, 6, 9}), A = values({1, 4, 3});
    std::vector<Vector> B{values({2}), values({0.5, 1})};

    RegressionData simulated_data(const Vector& instants = {}) const {
        const Experiment& experiment = data.experiments[0];
        const auto view = [](const auto& v) { return SampleView(v.data(), v.size()); };
        return {view(experiment.y.col(0)),
                {view(experiment.u.col(0)), view(second)},
                {0, 1},
                {0, 0.0137},
                {instants.size() > 0 ? 0 : data.Ts, SampleView(instants.data(), instants.size())}};
    }
};

Vector theta_of(const CommonDenominator& model) {
    return values({model.A[1], model.A[2], model.B[0][0], model.B[1][0], model.B[1][1]});
}

void expect_sum(const EstimatingTerms& terms, const NormalEquations& sums, const CommonDenominator& model) {
    const Vector by_sums = sums.z_y - sums.z_phi * theta_of(model), own = terms.Z.transpose() * terms.errors;
    EXPECT_LT((own - by_sums).norm(), 1e-9 * sums.z_y.norm());
}

// But for the first and the last sample, whose hold begins and ends there.
/// z' w, w the output errors v filtered by 3 A/E forwards; z as irregular instants give them, which are not turned.
Vector forwards(const TwoInputs& system, const CommonDenominator& model, const CommonDenominator* instrument) {
    const Vector instants = system.data.time();
    const Matrix z = estimating_terms(system.simulated_data(instants), system.E, 3, model, instrument).Z;
    const Vector x = lsim(TransferFunction(model.B[0], model.A), system.data.experiments[0].u.col(0), system.data.Ts) +
                     lsim(TransferFunction(model.B[1], model.A, 0, 0.0137), system.second, system.data.Ts);
    const Vector v = system.data.experiments[0].y.col(0) - x;
    const FilterChain coloring{SampleView(v.data(), v.size()), transfer_system(model.A, system.E), Hold::kFoh};
    return 3 * z.transpose() * chain_outputs(coloring, {system.data.Ts, SampleView(nullptr, 0)}).col(0);
}

TEST(estimating_terms, of_regular_records_are_those_of_the_output_errors_backwards) {
    const TwoInputs system;
    const CommonDenominator model{values({1, 3, 5}), {values({2.5}), values({0.4, 1.3})}};
    const CommonDenominator auxiliary{system.A, system.B};
    for (const CommonDenominator* instrument : {static_cast<const CommonDenominator*>(nullptr), &auxiliary}) {
        const EstimatingTerms terms = estimating_terms(system.simulated_data(), system.E, 3, model, instrument);
        const Vector own = terms.Z.transpose() * terms.errors;
        EXPECT_LT(relative_difference(own, forwards(system, model, instrument)), 5e-3);
    }
}

TEST(estimating_terms, of_an_auxiliary_model_have_the_sums_of_ivsvf) {
    const TwoInputs system;
    const CommonDenominator unstable{values({1, -0.1, 5}), {values({2.5}), values({0.4, 1.3})}};
    const CommonDenominator instrument{system.A, system.B};
    expect_sum(estimating_terms(system.simulated_data(), system.E, 3, unstable, &instrument),
               auxiliary_equations(system.simulated_data(), system.E, system.A, system.B, 3), unstable);
}

TEST(estimating_terms, are_the_equation_s_where_the_model_is_unstable_or_instants_are_irregular) {
    const TwoInputs system;
    const CommonDenominator unstable{values({1, -0.1, 5}), {values({2.5}), values({0.4, 1.3})}};
    expect_sum(estimating_terms(system.simulated_data(), system.E, 3, unstable),
               svf_equations(system.simulated_data(), system.E, 3), unstable);
    const Vector instants = system.data.time();
    const RegressionData irregular = system.simulated_data(instants);
    const CommonDenominator model{values({1, 3, 5}), {values({2.5}), values({0.4, 1.3})}};
    expect_sum(estimating_terms(irregular, system.E, 3, model), svf_equations(irregular, system.E, 3), model);
}

}  // namespace test_estimating_terms
