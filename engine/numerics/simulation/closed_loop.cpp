#include "numerics/simulation/closed_loop.h"

#include <cmath>
#include <string>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/models/convert.h"
#include "numerics/models/sampled_system.h"
#include "numerics/number_text.h"
#include "numerics/signals/checks.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kSameStep = 1e-9;  // relative difference of two sampling times that mean the same
constexpr const char* kEndlessAnswers =
    "closed loop: plant and controller both have a direct term (as many zeros as poles), so that each answers the "
    "other "
    "at the same instant without end; give the loop a computing delay, or one of the two a further pole";

void check_proper(const char* what, const TransferFunction& G) {
    if (G.proper()) return;
    throw InvalidArgument("closed loop: the " + std::string(what) + " has " + counted(G.zero_count(), "zero") +
                          " but only " + counted(G.pole_count(), "pole") +
                          "; it needs at least as many poles (the derivative of a PID needs a filter)");
}

void check_loop(const TransferFunction& plant, const LoopController& controller, double Ts) {
    check_sampling_time("closed loop", Ts);
    if (!plant.continuous()) throw InvalidArgument("closed loop: the plant must be a model in continuous time");
    check_proper("plant", plant);
    check_proper("controller", controller.C);
    if (controller.computing_delay < 0)
        throw InvalidArgument("closed loop: the computing delay must be a number of samples from 0 on, but it is " +
                              std::to_string(controller.computing_delay));
    if (controller.sampled()) {
        if (std::abs(controller.C.Ts() - Ts) <= kSameStep * Ts) return;
        throw InvalidArgument("closed loop: the controller has the sampling time " + number_text(controller.C.Ts()) +
                              " s, but the record " + number_text(Ts) + " s; both must be equal");
    }
    if (controller.computing_delay > 0)
        throw InvalidArgument(
            "closed loop: a computing delay belongs to a sampled controller, and this one is in continuous time");
    if (plant.delay() > 0 || controller.C.delay() > 0)
        throw InvalidArgument(
            "closed loop: a delay inside a loop with a controller in continuous time has no exact recursion; replace "
            "it by pade(G, n), or give a sampled controller");
}

/// Signals of the loop as rows over its states and the inputs r and v.
using Row = Eigen::RowVectorXd;

StateSpace continuous_loop(const TransferFunction& plant, const TransferFunction& controller) {
    const StateSpace G = to_state_space(plant), C = to_state_space(controller);
    const Index n = G.order(), total = n + C.order();
    const double endless = 1 + G.D(0, 0) * C.D(0, 0);
    if (endless == 0) throw InvalidArgument(kEndlessAnswers);
    Row u = Row::Zero(total + 2), x = u;
    u.segment(n, C.order()) = C.C.row(0);
    u.head(n) = -C.D(0, 0) * G.C.row(0);
    u.tail(2) << C.D(0, 0), -C.D(0, 0);
    u /= endless;
    x.head(n) = G.C.row(0);
    x += G.D(0, 0) * u;
    Row error = -x;
    error.tail(2) += Eigen::RowVector2d(1, -1);
    Matrix motion = Matrix::Zero(total, total + 2);
    motion.topLeftCorner(n, n) = G.A;
    motion.topRows(n) += G.B * u;
    motion.block(n, n, C.order(), C.order()) = C.A;
    motion.bottomRows(C.order()) += C.B * error;
    Matrix outputs(2, total + 2);
    outputs << x, u;
    return {motion.leftCols(total), motion.rightCols(2), outputs.leftCols(total), outputs.rightCols(2)};
}

/// States: the plant's, the last inputs u[k-1], u[k-2], ... as far as delays need them, the controller's.
StateSpace sampled_loop(const TransferFunction& plant, const LoopController& controller, double Ts) {
    const StateSpace form = to_state_space(plant);
    const SampledSystem G = discretise(form.A, form.B.col(0), form.C, form.D.col(0), Ts, Hold::kZoh, plant.delay());
    const auto late = static_cast<double>(controller.computing_delay) * Ts;
    const StateSpace C =
        to_state_space(with_rational_delay("closed loop", controller.C.with_delay(controller.C.delay() + late)));
    const Index n = form.order(), kept = G.delay + 1, total = n + kept + C.order();
    const auto past = [&](Index samples) -> Row { return Row::Unit(total + 2, n + samples - 1); };
    Row u = Row::Zero(total + 2), x = u;
    u.segment(n + kept, C.order()) = C.C.row(0);
    x.head(n) = G.C.row(0);
    x += G.D(0, 1) * past(G.delay + 1);
    const bool at_once = G.delay == 0 && G.D(0, 0) != 0;
    if (at_once && C.D(0, 0) != 0) throw InvalidArgument(kEndlessAnswers);
    if (G.delay > 0) x += G.D(0, 0) * past(G.delay);
    if (at_once) x += G.D(0, 0) * u;
    Row error = -x;
    error.tail(2) += Eigen::RowVector2d(1, -1);
    u += C.D(0, 0) * error;
    Matrix next = Matrix::Zero(total, total + 2);
    next.topLeftCorner(n, n) = G.F;
    next.topRows(n) += G.G.col(1) * (G.delay == 0 ? u : past(G.delay)) + G.G.col(2) * past(G.delay + 1);
    next.row(n) = u;
    for (Index i = 1; i < kept; ++i) next.row(n + i) = past(i);
    next.block(n + kept, n + kept, C.order(), C.order()) = C.A;
    next.bottomRows(C.order()) += C.B * error;
    Matrix outputs(2, total + 2);
    outputs << x, u;
    return {next.leftCols(total), next.rightCols(2), outputs.leftCols(total), outputs.rightCols(2), Ts};
}

StateSpace checked_loop(const TransferFunction& plant, const LoopController& controller, double Ts) {
    check_loop(plant, controller, Ts);
    return controller.sampled() ? sampled_loop(plant, controller, Ts) : continuous_loop(plant, controller.C);
}

}  // namespace

ClosedLoop::ClosedLoop(const TransferFunction& plant, const LoopController& controller, double Ts, Hold hold)
    : system_(checked_loop(plant, controller, Ts)),
      Ts_(Ts),
      hold_(hold),
      hold_of_record_(controller.sampled() ? Hold::kZoh : Hold::kFoh) {}

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

IdData ClosedLoop::record(const VectorView& r, const VectorView& v) const {
    if (r.size() != v.size())
        throw InvalidArgument("closed loop: the reference has " + std::to_string(r.size()) +
                              " samples but the noise has " + std::to_string(v.size()));
    if (!stable())
        throw InvalidArgument(
            "closed loop: the loop is unstable, so that its signals grow without bound; lower the controller's gain, "
            "or "
            "look at margin(C*G)");
    const Response wanted = to_reference(r), disturbed = to_disturbance(v);
    IdData data(Matrix(wanted.x + disturbed.x + v), Matrix(wanted.u + disturbed.u), Ts_);
    data.hold = hold_of_record_;
    return data.with_reference(Matrix(r));
}

}  // namespace dynlab::inline numerics
