#include "numerics/simulation/grey_simulation.h"

#include <cmath>
#include <utility>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/simulation/sensitivity_solver.h"

namespace dynlab::inline numerics {
namespace {

/// [B c]: the inputs and one.
Matrix with_constant(const GreyLinearSystem::Part& part) {
    Matrix B(part.B.rows(), part.B.cols() + 1);
    B << part.B, part.c;
    return B;
}

Vector with_one(const Matrix& u, Index k) {
    Vector all(u.cols() + 1);
    all.head(u.cols()) = u.row(k).transpose();
    all[u.cols()] = 1;
    return all;
}

}  // namespace

std::optional<StateSpace> linear_system_of(const GreyModel& model, const Vector& parameters) {
    if (!model.equations->is_linear() || !model.equations->has_linear_outputs()) return std::nullopt;
    const auto evaluation = model.equations->evaluation({});
    evaluation->set_parameters(parameters);
    const GreyLinearSystem::Part& rates = evaluation->linear_system()->value;
    const Vector zero = Vector::Zero(model.order());
    GreyValues at;
    Vector u = Vector::Zero(std::max<Index>(1, model.inputs));
    evaluation->outputs(0, zero.data(), u.data(), Derivatives::kState, at);
    if (!rates.c.isZero(0) || !at.values.isZero(0)) return std::nullopt;
    const Matrix C = at.by_state;
    Matrix D(C.rows(), model.inputs);
    for (Index j = 0; j < model.inputs; ++j) {
        u = Vector::Unit(u.size(), j);
        evaluation->outputs(0, zero.data(), u.data(), Derivatives::kNone, at);
        D.col(j) = at.values;
    }
    return StateSpace(rates.A, rates.B, C, D);
}

GreySimulator::GreySimulator(const GreyModel& model, Index outputs, GreyDirections directions,
                             double relative_tolerance)
    : model_(model),
      outputs_(outputs),
      directions_(std::move(directions)),
      tolerance_(relative_tolerance),
      evaluation_(model.equations->evaluation(directions_.parameters)) {
    const Index own = model.outputs_are_states ? model.order() : model.equations->output_count();
    if (outputs <= own && (outputs == own || model.outputs_are_states)) return;
    const Message given = plural(own, "{} output", "{} outputs");
    if (model.outputs_are_states)
        throw InvalidArgument("The model returns {}, but the data have {}: specify the option {}", given, outputs,
                              OptionName{"outputs"});
    throw InvalidArgument("The model returns {}, but the data have {}", given, outputs);
}

Vector GreySimulator::initial_state(const Vector& parameters) {
    evaluation_->set_parameters(parameters);
    evaluation_->initial_state(Derivatives::kNone, at_start_);
    return at_start_.values;
}

void GreySimulator::start(const Start& from, bool sensitivities) {
    const Index n = model_.order(), own = static_cast<Index>(directions_.parameters.size());
    S_ = RowMatrix::Zero(n, sensitivities ? directions_.count() : 0);
    if (from.replaced != nullptr) {
        x_ = *from.replaced;
    } else {
        evaluation_->initial_state(sensitivities ? Derivatives::kAll : Derivatives::kNone, at_start_);
        x_ = at_start_.values;
        if (sensitivities) S_.leftCols(own) = at_start_.by_parameter;
    }
    for (Index q = 0; q < from.estimated.size(); ++q) {
        const Index state = directions_.states[static_cast<std::size_t>(q)];
        x_[state] = from.estimated[q];
        if (!sensitivities) continue;
        S_.row(state).setZero();
        S_(state, own + q) = 1;
    }
}

void GreySimulator::write_outputs(const GreyInputs& inputs, Index k, bool sensitivities, GreyTrajectory& result) {
    const Index N = inputs.t.size();
    result.states.row(k) = x_.transpose();
    if (model_.outputs_are_states) {
        result.y.row(k) = x_.head(outputs_).transpose();
        if (sensitivities)
            for (Index i = 0; i < outputs_; ++i) result.sensitivities.row(i * N + k) = S_.row(i);
        return;
    }
    const Vector u = inputs.u.row(k).transpose();
    evaluation_->outputs(inputs.t[k], x_.data(), u.data(), sensitivities ? Derivatives::kAll : Derivatives::kNone,
                         at_output_);
    for (Index i = 0; i < outputs_; ++i) {
        if (!std::isfinite(at_output_.values[i]))
            throw SimulationBreakdown(
                "At t = {}, output {} of the model is {}. Check the output equations, for example for a division by "
                "zero",
                inputs.t[k], i + 1, at_output_.values[i]);
        result.y(k, i) = at_output_.values[i];
        if (!sensitivities) continue;
        auto row = result.sensitivities.row(i * N + k);
        row.noalias() = at_output_.by_state.row(i) * S_;
        row.head(at_output_.by_parameter.cols()) += at_output_.by_parameter.row(i);
    }
}

// The derivative of a step is a block of the step of [x; dx]: d/dt dx = A dx + A' x + B' u.
void GreySimulator::set_linear_steps(double h) {
    const GreyLinearSystem& system = *evaluation_->linear_system();
    const Index n = model_.order();
    const Matrix B = with_constant(system.value);
    for (Index i = 0; i < n; ++i)
        if (!system.value.A.row(i).allFinite() || !B.row(i).allFinite())
            throw SimulationBreakdown(
                "With these parameters, a coefficient in the derivative of the state {} is not a finite number. Check "
                "for a division by zero or a root of a negative number.",
                model_.state_names[static_cast<std::size_t>(i)]);
    const StepMatrices plain = exact_step(system.value.A, B, h);
    own_ = {plain.F, plain.H0, plain.H1};
    by_parameter_.resize(system.by_parameter.size());
    for (std::size_t q = 0; q < by_parameter_.size(); ++q) {
        const GreyLinearSystem::Part& slope = system.by_parameter[q];
        Matrix A2 = Matrix::Zero(2 * n, 2 * n), B2(2 * n, B.cols());
        A2.topLeftCorner(n, n) = A2.bottomRightCorner(n, n) = system.value.A;
        A2.bottomLeftCorner(n, n) = slope.A;
        B2 << B, with_constant(slope);
        const StepMatrices both = exact_step(A2, B2, h);
        by_parameter_[q] = {both.F.bottomLeftCorner(n, n), both.H0.bottomRows(n), both.H1.bottomRows(n)};
    }
    step_ = h;
}

void GreySimulator::advance_linear(const GreyInputs& inputs, Index k, bool sensitivities) {
    const double h = inputs.t[k + 1] - inputs.t[k];
    if (std::abs(h - step_) > 1e-9 * h) set_linear_steps(h);
    const Vector u0 = with_one(inputs.u, k), u1 = inputs.hold == Hold::kFoh ? with_one(inputs.u, k + 1) : u0;
    if (sensitivities) {
        S_ = (own_.F * S_).eval();
        for (std::size_t q = 0; q < by_parameter_.size(); ++q)
            S_.col(static_cast<Index>(q)) +=
                by_parameter_[q].F * x_ + by_parameter_[q].H0 * u0 + by_parameter_[q].H1 * u1;
    }
    x_ = (own_.F * x_ + own_.H0 * u0 + own_.H1 * u1).eval();
    if (!x_.allFinite())
        throw SimulationBreakdown(
            "At t = {}, the states become infinite, because the linear model is unstable. Check the matrices, or use "
            "other parameter values",
            inputs.t[k + 1]);
}

GreyTrajectory GreySimulator::run(const Vector& parameters, const GreyInputs& inputs, const Start& from,
                                  bool sensitivities) {
    evaluation_->set_parameters(parameters);
    step_ = -1;
    start(from, sensitivities);
    const Index N = inputs.t.size(), D = sensitivities ? directions_.count() : 0;
    GreyTrajectory result;
    result.y.resize(N, outputs_);
    result.states.resize(N, model_.order());
    result.sensitivities.resize(sensitivities ? N * outputs_ : 0, D);
    const bool linear = evaluation_->linear_system() != nullptr;
    const RowMatrix u = inputs.u;
    SensitivitySolver solver(*evaluation_, model_.state_names, u.cols(), D, tolerance_);
    for (Index k = 0; k < N; ++k) {
        write_outputs(inputs, k, sensitivities, result);
        if (k + 1 == N) break;
        if (linear) {
            advance_linear(inputs, k, sensitivities);
            continue;
        }
        const double *now = u.data() + k * u.cols(), *next = now + u.cols();
        solver.x.swap(x_);
        solver.S.swap(S_);
        solver.advance(inputs.t[k], inputs.t[k + 1], now, inputs.hold == Hold::kFoh ? next : now);
        solver.x.swap(x_);
        solver.S.swap(S_);
    }
    result.stiff = solver.is_stiff();
    result.rough_times = solver.rough_times();
    return result;
}

}  // namespace dynlab::inline numerics
