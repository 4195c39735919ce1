#include "numerics/simulation/closed_loop.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/models/convert.h"
#include "numerics/models/sampled_system.h"
#include "numerics/signals/checks.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kSameStep = 1e-9;  // relative difference of two sampling times that mean the same
[[noreturn]] void report_endless_answers(bool sampled) {
    if (sampled)
        throw InvalidArgument(
            "closed loop: plant and controller both have direct feedthrough (as many zeros as poles), which forms an "
            "algebraic loop. Add a computing delay, or add a pole to the plant or the controller");
    throw InvalidArgument(
        "closed loop: the product of the feedthrough gains of plant and controller is -1, which forms an algebraic "
        "loop without a solution. Change the gain, or add a pole to the plant or the controller");
}

void check_proper(const TransferFunction& plant, const TransferFunction& controller) {
    if (!plant.proper())
        throw InvalidArgument("closed loop: the plant has {} but only {}; it needs at least as many poles as zeros",
                              plural(plant.zero_count(), "{} zero", "{} zeros"),
                              plural(plant.pole_count(), "{} pole", "{} poles"));
    if (!controller.proper())
        throw InvalidArgument(
            "closed loop: the controller has {} but only {}; it needs at least as many poles as zeros (the derivative "
            "term of a PID controller needs a filter)",
            plural(controller.zero_count(), "{} zero", "{} zeros"),
            plural(controller.pole_count(), "{} pole", "{} poles"));
}

void check_loop(const TransferFunction& plant, const LoopController& controller, double Ts) {
    if (!valid_sampling_time(Ts))
        throw InvalidArgument("closed loop: the sampling time must be a positive number of seconds, but it is {}", Ts);
    if (!plant.continuous())
        throw InvalidArgument("closed loop: the plant must be a continuous-time model; convert it with d2c(G)");
    check_proper(plant, controller.C);
    if (controller.computing_delay < 0)
        throw InvalidArgument("closed loop: the computing delay must be a nonnegative number of samples, but it is {}",
                              controller.computing_delay);
    if (controller.sampled()) {
        if (std::abs(controller.C.Ts() - Ts) <= kSameStep * Ts) return;
        throw InvalidArgument(
            "closed loop: the sampling time of the controller is {} s, but the sampling time of the data is {} s. The "
            "sampling times must be equal",
            controller.C.Ts(), Ts);
    }
    if (controller.computing_delay > 0)
        throw InvalidArgument(
            "closed loop: a computing delay needs a sampled controller, but this controller is a continuous-time "
            "model; convert it with c2d(C, Ts)");
    if (plant.delay() > 0 || controller.C.delay() > 0)
        throw InvalidArgument(
            "closed loop: a loop with a delay and a continuous-time controller cannot be simulated exactly; "
            "approximate the delay with pade(G, n), or use a sampled controller");
}

/// The plant; or, as two copies of it, the plant and its derivative by one of its parameters: states [z; dz], inputs
/// [u; du] and outputs [x; dx]. Either copy has its own controller, which closes the same loop around it.
struct LoopPlant {
    StateSpace form;  ///< from the first copy's input to all outputs: what it does to the second one included
    Index copies = 1;
};

/// What the inputs of all copies do, one column each: a copy does to itself what the first does to itself, and so on.
Matrix of_all_inputs(const VectorView& of_first, Index copies) {
    const Index part = of_first.size() / copies;
    Matrix all = Matrix::Zero(of_first.size(), copies);
    for (Index copy = 0; copy < copies; ++copy)
        all.col(copy).tail(of_first.size() - copy * part) = of_first.head(of_first.size() - copy * part);
    return all;
}

/// [x; u] of the first copy in a loop with r and v as inputs, then those of the second. `x_of` and `u_of` are rows over
/// the loop's states, then r and v.
Matrix loop_outputs(const Matrix& x_of, const Matrix& u_of) {
    Matrix outputs(2 * x_of.rows(), x_of.cols());
    for (Index copy = 0; copy < x_of.rows(); ++copy) outputs.middleRows(2 * copy, 2) << x_of.row(copy), u_of.row(copy);
    return outputs;
}

/// What the controllers read: r - v - x and, for a derivative, -dx.
Matrix control_errors(const Matrix& x_of) {
    Matrix errors = -x_of;
    errors.row(0).tail(2) += Eigen::RowVector2d(1, -1);
    return errors;
}

StateSpace continuous_loop(const LoopPlant& plant, const TransferFunction& controller) {
    const StateSpace& G = plant.form;
    const StateSpace C = to_state_space(controller);
    const Index n = G.order(), copies = plant.copies, total = n + copies * C.order();
    const Matrix D = of_all_inputs(G.D.col(0), copies);
    if (1 + D(0, 0) * C.D(0, 0) == 0) report_endless_answers(false);
    Matrix u = Matrix::Zero(copies, total + 2), x = u;
    x.leftCols(n) = G.C;
    u = C.D(0, 0) * control_errors(x);
    for (Index copy = 0; copy < copies; ++copy) u.row(copy).segment(n + copy * C.order(), C.order()) += C.C.row(0);
    u = solve_by_lu(Matrix::Identity(copies, copies) + C.D(0, 0) * D, u).x;
    x += D * u;
    const Matrix errors = control_errors(x);
    Matrix motion = Matrix::Zero(total, total + 2);
    motion.topLeftCorner(n, n) = G.A;
    motion.topRows(n) += of_all_inputs(G.B.col(0), copies) * u;
    for (Index copy = 0; copy < copies; ++copy) {
        const Index first = n + copy * C.order();
        motion.block(first, first, C.order(), C.order()) = C.A;
        motion.middleRows(first, C.order()) += C.B * errors.row(copy);
    }
    const Matrix outputs = loop_outputs(x, u);
    return {motion.leftCols(total), motion.rightCols(2), outputs.leftCols(total), outputs.rightCols(2)};
}

/// States: the plant's, the last inputs u[k-1], u[k-2], ... that the delays need, the controllers'.
StateSpace sampled_loop(const LoopPlant& plant, double delay, const LoopController& controller, double Ts) {
    const StateSpace& form = plant.form;
    const SampledSystem G = discretize(form.A, form.B.col(0), form.C, form.D.col(0), Ts, Hold::kZoh, delay);
    const auto late = static_cast<double>(controller.computing_delay) * Ts;
    const StateSpace C =
        to_state_space(with_rational_delay("closed loop", controller.C.with_delay(controller.C.delay() + late)));
    const Index n = form.order(), copies = plant.copies, kept = G.delay + 1;
    const Index controllers = n + kept * copies, total = controllers + copies * C.order();
    const Matrix at_once = of_all_inputs(G.D.col(0), copies), before = of_all_inputs(G.D.col(1), copies);
    const auto past = [&](Index samples) {
        Matrix rows = Matrix::Zero(copies, total + 2);
        rows.middleCols(n + (samples - 1) * copies, copies).setIdentity();
        return rows;
    };
    const bool answers_at_once = G.delay == 0 && !at_once.isZero(0);
    if (answers_at_once && C.D(0, 0) != 0) report_endless_answers(true);
    Matrix u = Matrix::Zero(copies, total + 2), x = u;
    for (Index copy = 0; copy < copies; ++copy)
        u.row(copy).segment(controllers + copy * C.order(), C.order()) = C.C.row(0);
    x.leftCols(n) = G.C;
    x += before * past(G.delay + 1);
    if (G.delay > 0) x += at_once * past(G.delay);
    if (answers_at_once) x += at_once * u;
    const Matrix errors = control_errors(x);
    u += C.D(0, 0) * errors;
    Matrix next = Matrix::Zero(total, total + 2);
    next.topLeftCorner(n, n) = G.F;
    next.topRows(n) += of_all_inputs(G.G.col(1), copies) * (G.delay == 0 ? u : past(G.delay)) +
                       of_all_inputs(G.G.col(2), copies) * past(G.delay + 1);
    next.middleRows(n, copies) = u;
    for (Index i = 1; i < kept; ++i) next.middleRows(n + i * copies, copies) = past(i);
    for (Index copy = 0; copy < copies; ++copy) {
        const Index first = controllers + copy * C.order();
        next.block(first, first, C.order(), C.order()) = C.A;
        next.middleRows(first, C.order()) += C.B * errors.row(copy);
    }
    const Matrix outputs = loop_outputs(x, u);
    return {next.leftCols(total), next.rightCols(2), outputs.leftCols(total), outputs.rightCols(2), Ts};
}

StateSpace loop_around(const LoopPlant& plant, double delay, const LoopController& controller, double Ts) {
    return controller.sampled() ? sampled_loop(plant, delay, controller, Ts) : continuous_loop(plant, controller.C);
}

/// The plant and its derivative by parameter i of [a_1 .. a_n b_0 .. b_zeros].
LoopPlant with_derivative(const StateSpace& G, Index zeros, Index i) {
    const Index n = G.order();
    Matrix dA = Matrix::Zero(n, n), dC = Matrix::Zero(1, n), dD = Matrix::Zero(1, 1);
    // Controllable form: A begins with the row -a', C = (b_1 .. b_n) - b_0 a' and D = b_0, B of degree n.
    const Index numerator = i - zeros;  // place among b_0 .. b_n
    if (i < n) {
        dA(0, i) = -1;
        dC(0, i) = -G.D(0, 0);
    } else if (numerator > 0) {
        dC(0, numerator - 1) = 1;
    } else {
        if (n > 0) dC = G.A.row(0);
        dD(0, 0) = 1;
    }
    const Matrix none = Matrix::Zero(n, n);
    Matrix A(2 * n, 2 * n), B(2 * n, 1), C(2, 2 * n), D(2, 1);
    A << G.A, none, dA, G.A;
    B << G.B, Matrix::Zero(n, 1);
    C << G.C, Matrix::Zero(1, n), dC, G.C;
    D << G.D, dD;
    return {{A, B, C, D}, 2};
}

StateSpace checked_loop(const TransferFunction& plant, const LoopController& controller, double Ts) {
    check_loop(plant, controller, Ts);
    return loop_around({to_state_space(plant)}, plant.delay(), controller, Ts);
}

}  // namespace

ClosedLoop::ClosedLoop(const TransferFunction& plant, const LoopController& controller, double Ts, Hold hold)
    : plant_(plant),
      controller_(controller),
      system_(checked_loop(plant, controller, Ts)),
      Ts_(Ts),
      hold_(hold),
      data_hold_(controller.sampled() ? Hold::kZoh : Hold::kFoh) {}

bool ClosedLoop::stable() const {
    if (system_.order() == 0) return true;
    const ComplexVector poles = eigenvalues(system_.A);
    return system_.Ts > 0 ? (poles.array().abs() < 1).all() : (poles.real().array() < 0).all();
}

ClosedLoop::Response ClosedLoop::response(const VectorView& signal, Index input, Hold hold) const {
    const StateSpace from_one{system_.A, system_.B.col(input), system_.C, system_.D.col(input), system_.Ts};
    const Matrix outputs = lsim(from_one, signal, Ts_, hold);
    return {outputs.col(1), outputs.col(0)};
}

Matrix ClosedLoop::sensitivities(const VectorView& r, int zeros) const {
    const StateSpace plant = to_state_space(plant_);
    Matrix psi(r.size(), plant.order() + zeros + 1);
    for (Index i = 0; i < psi.cols(); ++i) {
        const StateSpace loop = loop_around(with_derivative(plant, zeros, i), plant_.delay(), controller_, Ts_);
        const StateSpace derivative{loop.A, loop.B.col(0), loop.C.row(2), loop.D.block(2, 0, 1, 1), loop.Ts};
        psi.col(i) = lsim(derivative, r, Ts_, hold_);
    }
    return psi;
}

IdData ClosedLoop::simulate(const VectorView& r, const VectorView& v) const {
    if (r.size() != v.size())
        throw InvalidArgument("closed loop: the reference has {}, but the noise has {}",
                              plural(r.size(), "{} sample", "{} samples"), v.size());
    if (!stable())
        throw InvalidArgument(
            "closed loop: the loop is unstable, so its signals grow without bound; decrease the controller's gain, or "
            "check margin(C*G)");
    const Response requested = to_reference(r), disturbed = to_disturbance(v);
    IdData data(Matrix(requested.x + disturbed.x + v), Matrix(requested.u + disturbed.u), Ts_);
    data.hold = data_hold_;
    return data.with_reference(Matrix(r));
}

}  // namespace dynlab::inline numerics
