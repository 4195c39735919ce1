#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/reader.h"
#include "numerics/criteria/discrete_output.h"
#include "numerics/linalg/polynomial.h"
#include "support/difference_equation.h"

namespace test_discrete_output {

using namespace dynlab;
using namespace dynlab::test;

const PolynomialOrders kOrders = PolynomialOrders::output_error({2, 1}, {1, 2}, {0, 3});
const Vector kModel{{-0.7, 1, 0.5, -1.3, 0.6, 2}};

std::vector<SampledExperiment> experiments() {
    std::vector<SampledExperiment> list;
    for (std::uint32_t seed : {1u, 2u}) {
        const Index N = 30 + 10 * static_cast<Index>(seed);
        SampledExperiment experiment{Matrix(N, 2), RandomStream(seed + 5).normal(N)};
        experiment.u << random_levels(N, 3, seed).array() + 0.5, random_levels(N, 4, seed + 10);
        list.push_back(experiment);
    }
    return list;
}

Vector some_parameters(const DiscreteOutput& model) {
    Vector theta = RandomStream(9).normal(model.parameter_count());
    theta.head(kModel.size()) = kModel;
    return theta;
}

double worst(const Matrix& a, const Matrix& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

const std::vector<StartCondition>& conditions() {
    static const std::vector<StartCondition> kAll = {{InitialState::kZero, false},     {InitialState::kZero, true},
                                                     {InitialState::kSteady, false},   {InitialState::kSteady, true},
                                                     {InitialState::kEstimate, false}, {InitialState::kEstimate, true}};
    return kAll;
}

TEST(discrete_output, follows_the_difference_equation) {  // oracle: the recursion
    const auto list = experiments();
    const DiscreteOutput model(kOrders, {InitialState::kZero, false}, list);
    Vector output;
    model.simulate(kModel, output, nullptr);
    const PolynomialModel same(kOrders, kModel, 1);
    const Vector first = model_output(same, list[0].u, Vector::Zero(40)),
                 second = model_output(same, list[1].u, Vector::Zero(50));
    EXPECT_LT(worst(output.head(40), first), 1e-13);
    EXPECT_LT(worst(output.tail(50), second), 1e-13);
    EXPECT_EQ(model.target().head(40), list[0].y);
}

TEST(discrete_output, sensitivities_are_derivatives) {  // oracle: central differences
    const auto list = experiments();
    for (const StartCondition& condition : conditions()) {
        const DiscreteOutput model(kOrders, condition, list);
        const Vector theta = some_parameters(model);
        Vector output, ahead, behind;
        Matrix sensitivities;
        model.simulate(theta, output, &sensitivities);
        model.simulate(theta, ahead, nullptr);
        EXPECT_LT(worst(output, ahead), 1e-13);
        for (Index i = 0; i < theta.size(); ++i) {
            const Vector step = 1e-6 * Vector::Unit(theta.size(), i);
            model.simulate(theta + step, ahead, nullptr);
            model.simulate(theta - step, behind, nullptr);
            EXPECT_LT(worst(sensitivities.col(i), (ahead - behind) / 2e-6), 1e-6 * sensitivities.col(i).norm())
                << message_text(description(condition)) << " " << i;
        }
    }
}

TEST(discrete_output, a_steady_start_has_a_constant_past) {  // oracle: longer data with a constant beginning
    auto list = experiments();
    list.resize(1);
    const DiscreteOutput model(kOrders, {InitialState::kSteady, false}, list);
    Vector output;
    model.simulate(kModel, output, nullptr);
    Matrix longer(540, 2);
    longer << list[0].u.row(0).replicate(500, 1), list[0].u;
    const Vector all = model_output(PolynomialModel(kOrders, kModel, 1), longer, Vector::Zero(540));
    EXPECT_LT(worst(output, all.tail(40)), 1e-10);
}

TEST(discrete_output, initial_values_hold_any_past) {  // oracle: data cut from a longer signal
    Matrix u(90, 2);
    u << random_levels(90, 3, 1), random_levels(90, 5, 2);
    const Vector y = model_output(PolynomialModel(kOrders, kModel, 1), u, Vector::Zero(90));
    const std::vector<SampledExperiment> list{{u.bottomRows(60), y.tail(60)}};
    const DiscreteOutput model(kOrders, {InitialState::kEstimate, false}, list);
    EXPECT_EQ(model.head(), 1);  // nk + nb - 1 - nf of the second input
    EXPECT_EQ(model.target().size(), 59);
    EXPECT_EQ(model.left_out(), 1);
    Vector theta = Vector::Zero(model.parameter_count()), output;
    theta.head(6) = kModel;
    Matrix sensitivities;
    model.simulate(theta, output, &sensitivities);
    const Matrix motions = sensitivities.rightCols(3);
    const Vector error = model.target() - output;
    const Vector values = motions.householderQr().solve(error);
    EXPECT_GT(error.norm(), 0.1);
    EXPECT_LT((motions * values - error).norm(), 1e-10);
}

/// Oracle: Psi and Phi written out, from the filtered signals of each experiment; two inputs.
TEST(discrete_output, instrument_products_are_those_of_the_filtered_signals) {
    const PolynomialOrders orders = PolynomialOrders::output_error({1, 2}, {2, 1}, {2, 1});
    const Vector theta{{-1.3, 0.6, -0.4, 2, 1, -0.5}};
    std::vector<SampledExperiment> list;
    for (const Index N : {40, 700}) {
        Matrix u(N, 2);
        u << random_levels(N, 3, 1), random_levels(N, 2, 4);
        list.push_back({u, RandomStream(2).normal(N)});
    }
    const DiscreteOutput model(orders, {InitialState::kZero, false}, list);
    Matrix psi_psi = Matrix::Zero(6, 6), psi_phi = psi_psi, phi_phi = psi_psi;
    Vector psi_e = Vector::Zero(6), phi_e = psi_e;
    double squares = 0;
    const Vector F[2] = {Vector{{1, -1.3, 0.6}}, Vector{{1, -0.4}}}, B[2] = {Vector{{0, 0, 2}}, Vector{{0, 1, -0.5}}};
    for (const SampledExperiment& one : list) {
        Matrix Psi(one.y.size(), 6), Phi = Psi;
        Vector x[2], e = one.y;
        for (Index i : {0, 1}) {
            x[i] = weighted_past(B[i], divided_by(F[i], one.u.col(i)));
            e -= x[i];
        }
        const auto fill = [&](Matrix& M, const Vector& first, const Vector& second) {
            M.col(0) = weighted_past(Vector{{0, -1}}, divided_by(F[0], first));
            M.col(1) = weighted_past(Vector{{0, 0, -1}}, divided_by(F[0], first));
            M.col(2) = weighted_past(Vector{{0, -1}}, divided_by(F[1], second));
            M.col(3) = weighted_past(Vector{{0, 0, 1}}, divided_by(F[0], one.u.col(0)));
            M.col(4) = weighted_past(Vector{{0, 1}}, divided_by(F[1], one.u.col(1)));
            M.col(5) = weighted_past(Vector{{0, 0, 1}}, divided_by(F[1], one.u.col(1)));
        };
        fill(Psi, x[0], x[1]);
        fill(Phi, x[0] + e, x[1] + e);  // what is measured of each output, once the other is taken off
        psi_psi += Psi.transpose() * Psi;
        psi_phi += Psi.transpose() * Phi;
        phi_phi += Phi.transpose() * Phi;
        psi_e += Psi.transpose() * e;
        phi_e += Phi.transpose() * e;
        squares += e.squaredNorm();
    }
    const auto order = std::vector<Index>{orders.f_start(0), orders.f_start(0) + 1, orders.f_start(1),
                                          orders.b_start(0), orders.b_start(1),     orders.b_start(1) + 1};
    Vector placed(6);
    placed(order) = theta;
    const InstrumentProducts products = model.instrument_products(placed, model.target());
    EXPECT_NEAR(products.squares, squares, 1e-10 * squares);
    EXPECT_LT((Matrix(products.psi_psi(order, order)) - psi_psi).norm(), 1e-11 * psi_psi.norm());
    EXPECT_LT((Matrix(products.psi_phi(order, order)) - psi_phi).norm(), 1e-11 * psi_phi.norm());
    EXPECT_LT((Matrix(products.phi_phi(order, order)) - phi_phi).norm(), 1e-11 * phi_phi.norm());
    EXPECT_LT((Vector(products.psi_e(order)) - psi_e).norm(), 1e-11 * std::sqrt(psi_psi.norm() * squares));
    EXPECT_LT((Vector(products.phi_e(order)) - phi_e).norm(), 1e-11 * std::sqrt(phi_phi.norm() * squares));
}

TEST(discrete_output, poles_are_mirrored) {  // oracle: definition
    const ComplexVector poles{{Complex(1.2, 0.5), Complex(1.2, -0.5), Complex(-0.4, 0)}};
    const Vector f = polynomial_from_roots(poles).tail(3), mirrored = reflect_poles_into_unit_circle(f);
    Vector p(4);
    p << 1, mirrored;
    for (const Complex& pole : {1.0 / Complex(1.2, 0.5), 1.0 / Complex(1.2, -0.5), Complex(-0.4, 0)})
        EXPECT_LT(std::abs(evaluate(p, pole)), 1e-13);
    EXPECT_EQ(reflect_poles_into_unit_circle(mirrored), mirrored);
    EXPECT_EQ(reflect_poles_into_unit_circle(Vector()).size(), 0);
}

}  // namespace test_discrete_output
