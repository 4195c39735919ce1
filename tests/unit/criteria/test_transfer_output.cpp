#include <gtest/gtest.h>

#include <cmath>

#include "numerics/criteria/transfer_output.h"
#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"

namespace test_transfer_output {

using namespace dynlab;

constexpr Index kN = 120;
constexpr double kTs = 0.1;

Matrix rough_inputs(Index N, Index inputs, std::uint32_t seed) {
    RandomStream stream(seed);
    Matrix u(N, inputs);
    for (Index j = 0; j < inputs; ++j) {
        const Vector noise = stream.normal(N);
        for (Index k = 0; k < N; ++k) u(k, j) = 0.5 + noise[k / 7];
    }
    return u;
}

// Two experiments of different length.
IdData simulated_data(Index outputs, Index inputs, Hold hold, bool regular) {
    std::vector<IdData> parts;
    for (Index e = 0; e < 2; ++e) {
        const Index N = kN - 30 * e;
        const Matrix u = rough_inputs(N, inputs, 3 + static_cast<std::uint32_t>(e)), y = Matrix::Random(N, outputs);
        Vector t(N);
        for (Index k = 0; k < N; ++k)
            t[k] = 5 + kTs * (static_cast<double>(k) + 0.3 * std::sin(static_cast<double>(k)));
        parts.push_back(regular ? IdData(y, u, kTs) : IdData(y, u, t));
        parts.back().hold = hold;
    }
    return IdData::merge(parts);
}

struct Case {
    Denominators sharing;
    Index outputs, inputs;
    std::vector<int> poles, zeros;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> kCases = {
        {Denominators::kCommon, 1, 1, {2}, {0}},           {Denominators::kCommon, 1, 1, {2}, {1}},
        {Denominators::kPerChannel, 1, 2, {2, 3}, {0, 2}}, {Denominators::kPerOutput, 2, 2, {2, 2, 1, 1}, {1, 0, 0, 0}},
        {Denominators::kCommon, 2, 2, {2}, {1, 0, 0, 1}},
    };
    return kCases;
}

// Lively, stable values in time units.
Vector some_values(const TransferStructure& structure, const TransferOutput& model) {
    Vector theta = Vector::Random(model.parameter_count());
    for (std::size_t d = 0; d < structure.poles.size(); ++d) {
        const int n = structure.poles[d];
        const Vector a = n == 1 ? Vector{{0.2}} : n == 2 ? Vector{{0.25, 0.05}} : Vector{{0.6, 0.15, 0.01}};
        theta.segment(structure.denominator_start(static_cast<Index>(d)), n) = a;
    }
    if (structure.free_delays)
        for (Index o = 0; o < structure.outputs; ++o)
            for (Index i = 0; i < structure.inputs; ++i)
                theta[structure.delay_index(o, i)] = 1.37 + static_cast<double>(i);
    return theta;
}

TEST(transfer_output, sensitivities_agree_with_differences) {  // oracle: second route, central differences
    for (const Case& c : cases())
        for (const Hold hold : {Hold::kZoh, Hold::kFoh})
            for (const bool regular : {true, false})
                for (const bool estimate : {false, true}) {
                    TransferStructure structure =
                        TransferStructure::grid(c.outputs, c.inputs, c.sharing, c.poles, c.zeros, {0.0});
                    structure.free_delays = true;
                    TransferOutput model(structure,
                                         {estimate ? InitialState::kEstimate : InitialState::kSteady, estimate},
                                         simulated_data(c.outputs, c.inputs, hold, regular), 0, 1);
                    model.set_weights(Vector::LinSpaced(c.outputs, 1, 3));
                    const Vector theta = some_values(structure, model);
                    Vector output, plus, minus;
                    Matrix sensitivities;
                    model.simulate(theta, output, &sensitivities);
                    model.simulate(theta, plus, nullptr);
                    EXPECT_LT((output - plus).cwiseAbs().maxCoeff(), 1e-11);
                    for (Index i = 0; i < theta.size(); ++i) {
                        const double h = 1e-6;
                        model.simulate(theta + h * Vector::Unit(theta.size(), i), plus, nullptr);
                        model.simulate(theta - h * Vector::Unit(theta.size(), i), minus, nullptr);
                        const Vector d = (plus - minus) / (2 * h);
                        EXPECT_LT((d - sensitivities.col(i)).cwiseAbs().maxCoeff(),
                                  2e-6 * (1 + d.cwiseAbs().maxCoeff()))
                            << "parameter " << i << " regular " << regular << " poles " << c.poles[0];
                    }
                }
}

TEST(transfer_output, equals_lsim_channel_by_channel) {  // oracle: second route, lsim
    for (const bool regular : {true, false}) {
        const IdData data = simulated_data(2, 2, Hold::kZoh, regular);
        const TransferStructure structure =
            TransferStructure::grid(2, 2, Denominators::kCommon, {2}, {1, 0, 2, 0}, {0.0, 0.23, 0.3, 1});
        const TransferOutput model(structure, {InitialState::kZero, false}, data, 0, 0);
        const Vector theta{{0.9, 4.0, 1.0, 2.0, 3.0, 0.4, 0.5, 0.6, -1.0}};
        Vector output;
        model.simulate(theta.cwiseQuotient(model.seconds()), output, nullptr);
        const auto G = structure.models(theta);
        for (std::size_t e = 0; e < 2; ++e)
            for (Index o = 0; o < 2; ++o) {
                const Experiment& experiment = data.experiments[e];
                Vector expected = Vector::Zero(model.rows(e));
                for (Index i = 0; i < 2; ++i) {
                    const TransferFunction& channel = G[static_cast<std::size_t>(2 * o + i)];
                    expected += regular ? lsim(channel, experiment.u.col(i), kTs)
                                        : lsim(channel, experiment.u.col(i), experiment.t);
                }
                EXPECT_LT((output.segment(model.row(e, o), model.rows(e)) - expected).cwiseAbs().maxCoeff(), 1e-11);
                EXPECT_EQ(model.target().segment(model.row(e, o), model.rows(e)), experiment.y.col(o));
            }
    }
}

TEST(transfer_output, initial_values_are_derivatives_at_the_first_sample) {  // oracle: analytic
    const IdData data(Matrix::Zero(50, 1), Matrix::Zero(50, 1), 0.2);
    const TransferStructure structure = TransferStructure::single(2, 0);
    const TransferOutput model(structure, {InitialState::kEstimate, true}, data, 0, 0);
    const double w = 1.3, position = 2, speed = -3, offset = 7;
    const Vector theta{{0.0, w * w, 1.0, position, speed, offset}};
    ASSERT_EQ(model.parameter_count(), 6);
    Vector output;
    model.simulate(theta.cwiseQuotient(model.seconds()), output, nullptr);
    for (Index k = 0; k < 50; ++k) {
        const double t = 0.2 * static_cast<double>(k);
        EXPECT_NEAR(output[k], offset + position * std::cos(w * t) + speed / w * std::sin(w * t), 1e-12);
    }
}

TEST(transfer_output, reports_what_bears_on_each_output) {  // oracle: definition, columns of the sensitivities
    TransferStructure structure = TransferStructure::grid(2, 2, Denominators::kPerOutput, {2, 2, 1, 1}, {0}, {0.0});
    structure.free_delays = true;
    const TransferOutput model(structure, {InitialState::kEstimate, true}, simulated_data(2, 2, Hold::kZoh, true), 0,
                               1);
    Vector output;
    Matrix sensitivities;
    model.simulate(some_values(structure, model), output, &sensitivities);
    for (Index o = 0; o < 2; ++o)
        for (Index i = 0; i < model.parameter_count(); ++i) {
            double size = 0;
            for (std::size_t e = 0; e < 2; ++e)
                size += sensitivities.col(i).segment(model.row(e, o), model.rows(e)).norm();
            EXPECT_EQ(size > 0, model.bears_on(o)[static_cast<std::size_t>(i)]) << o << " " << i;
        }
}

TEST(transfer_output, has_no_end_instead_of_failing) {  // oracle: definition
    const TransferStructure structure = TransferStructure::single(2, 0);
    const TransferOutput model(structure, {InitialState::kZero, false}, simulated_data(1, 1, Hold::kZoh, true), 0, 0);
    Vector output;
    for (const double a : {1e300, -1e12, -1e4, std::nan("")}) {
        model.simulate(Vector{{a, 1.0, 1.0}}, output, nullptr);
        EXPECT_FALSE(output.allFinite()) << a;
    }
    EXPECT_THROW(TransferOutput(structure, {InitialState::kZero, false}, simulated_data(2, 1, Hold::kZoh, true), 0, 0),
                 InvalidArgument);
}

/// Oracle: the poles, which are given.
TEST(transfer_output, bounds_of_stable_models_let_slow_ones_be) {
    const IdData data = simulated_data(1, 1, Hold::kZoh, true);
    for (const double radians : {1.0, 1e-2, 1e-4}) {  // of the slowest pole in a sample
        const TransferStructure structure = TransferStructure::single(6, 0);
        TransferOutput model(structure, {InitialState::kZero, false}, data, 0, 0);
        model.keep_stable();
        ComplexVector poles(6);
        for (Index i = 0; i < 6; ++i) poles[i] = -radians * static_cast<double>(1 + i);
        Vector theta = Vector::Ones(model.parameter_count()), output;
        theta.head(6) = polynomial_from_roots(poles).tail(6);
        theta = theta.cwiseMax(model.lower()).cwiseMin(model.upper());
        EXPECT_EQ(Vector(theta.head(6)), Vector(polynomial_from_roots(poles).tail(6))) << radians;
        model.simulate(theta, output, nullptr);
        EXPECT_TRUE(output.allFinite()) << radians;
    }
}

}  // namespace test_transfer_output
