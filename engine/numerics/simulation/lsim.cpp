#include "numerics/simulation/lsim.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"
#include "numerics/signals/checks.h"
#include "numerics/simulation/exact_filter.h"
#include "numerics/simulation/irregular_filter.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kGridRounding = 1e-9;  // relative difference of two sampling times that mean the same

void check_model(const TransferFunction& G) {
    if (G.proper()) return;
    throw InvalidArgument(
        "lsim: the transfer function has {} but only {}; a simulation needs a model with at least as many poles as "
        "zeros",
        plural(G.zero_count(), "{} zero", "{} zeros"), plural(G.pole_count(), "{} pole", "{} poles"));
}

Vector initial_state(const VectorView& x0, Index order) {
    if (x0.size() == 0) return Vector::Zero(order);
    if (x0.size() != order)
        throw InvalidArgument("lsim: the initial state x0 must have {}, one for each state, but it has {}",
                              plural(order, "{} value", "{} values"), x0.size());
    if (!x0.allFinite()) throw InvalidArgument("lsim: the initial state x0 contains a value that is not finite");
    return x0;
}

void check_discrete_sampling(double model_Ts, double Ts) {
    if (std::abs(model_Ts - Ts) <= kGridRounding * Ts) return;
    throw InvalidArgument(
        "lsim: the sampling time of the discrete-time model is {} s, but the sampling time of the data is {} s. The "
        "sampling times must be equal",
        model_Ts, Ts);
}

/// The sampling time of equally spaced instants, 0 of others.
double regular_sampling_time(const VectorView& t) {
    const Index intervals = t.size() - 1;
    const double Ts = (t(intervals) - t(0)) / static_cast<double>(intervals);
    const double largest_rounding = kGridRounding * Ts;
    for (Index k = 1; k < intervals; ++k)
        if (std::abs(t(k) - t(0) - static_cast<double>(k) * Ts) > largest_rounding) return 0;
    return Ts;
}

}  // namespace

Vector lsim(const TransferFunction& G, const VectorView& u, double Ts, Hold hold, const VectorView& x0) {
    check_model(G);
    check_sampling_time("lsim", Ts);
    check_samples("lsim", SignalName::kInput, u.head(std::min<Index>(u.size(), 1)));
    if (!G.continuous()) check_discrete_sampling(G.Ts(), Ts);
    const StateSpace form = to_state_space(G);
    const ExactFilter filter(
        G.continuous()
            ? discretize(form.A, form.B.col(0), form.C, form.D.col(0), Ts, hold, G.delay())
            : discrete_system(form.A, form.B.col(0), form.C, form.D.col(0), split_delay(G.delay(), Ts).samples));
    Vector y(u.size());
    filter.run(u, initial_state(x0, form.order()), y);
    // A sample that is not finite stays in the state and shows in the last output, unless it came too late for that or
    // there is no state: so a long input need not be read once more.
    const Index late = std::min(u.size(), split_delay(G.delay(), Ts).samples + 3);
    if (form.order() == 0 || !std::isfinite(y[y.size() - 1]) || !u.tail(late).allFinite())
        check_samples("lsim", SignalName::kInput, u);
    return y;
}

Vector lsim(const TransferFunction& G, const VectorView& u, const VectorView& t, Hold hold, const VectorView& x0) {
    if (u.size() != t.size())
        throw InvalidArgument("lsim: the input has {}, but the time vector has {}",
                              plural(u.size(), "{} sample", "{} samples"), t.size());
    check_samples("lsim", SignalName::kInput, u);
    check_instants("lsim", t);
    const double regular_Ts = t.size() > 1 ? regular_sampling_time(t) : G.continuous() ? 1 : G.Ts();
    if (regular_Ts > 0) return lsim(G, u, regular_Ts, hold, x0);
    if (!G.continuous())
        throw InvalidArgument(
            "lsim: a discrete-time model needs equally spaced instants, but the instants of the time vector are not "
            "equally spaced");
    check_model(G);
    const StateSpace form = to_state_space(G);
    IrregularFilter filter(form.A, form.B.col(0), form.C, form.D.col(0), hold, G.delay());
    return filter.run(u, t, initial_state(x0, form.order()));
}

Matrix lsim(const StateSpace& system, const MatrixView& u, double Ts, Hold hold, const VectorView& x0) {
    check_sampling_time("lsim", Ts);
    check_samples("lsim", SignalName::kInput, u);
    if (u.cols() != system.B.cols())
        throw InvalidArgument("lsim: the system has {}, but the data have {}",
                              plural(system.B.cols(), "{} input", "{} inputs"),
                              plural(u.cols(), "{} input channel", "{} input channels"));
    if (system.Ts > 0) check_discrete_sampling(system.Ts, Ts);
    Vector state = initial_state(x0, system.order());
    Matrix y = Matrix::Zero(u.rows(), system.C.rows()), share(u.rows(), system.C.rows());
    for (Index input = 0; input < u.cols(); ++input) {
        const auto B = system.B.col(input), D = system.D.col(input);
        const ExactFilter filter(system.Ts > 0 ? discrete_system(system.A, B, system.C, D, 0)
                                               : discretize(system.A, B, system.C, D, Ts, hold));
        filter.run(u.col(input), state, share);
        y += share;
        state.setZero();  // the initial state moves the outputs once
    }
    return y;
}

Matrix state_variable_filter(const VectorView& x, int n, double lambda, double Ts, Hold hold) {
    constexpr int kMaxOrder = 50;
    if (n < 1 || n > kMaxOrder)
        throw InvalidArgument("state-variable filter: the order must be between 1 and {}, but it is {}", kMaxOrder, n);
    if (!(lambda > 0) || !std::isfinite(lambda))
        throw InvalidArgument(
            "state-variable filter: the cutoff frequency lambda must be a positive number of rad/s, but it is {}",
            lambda);
    if (!valid_sampling_time(Ts))
        throw InvalidArgument(
            "state-variable filter: the sampling time must be a positive number of seconds, but it is {}", Ts);
    if (const Message error = error_in_samples(SignalName::kSignal, x); !error.empty())
        throw InvalidArgument("state-variable filter: {}", error);
    return ExactFilter(derivative_filter(power(Eigen::Vector2d(1, lambda), n), Ts, hold)).run(x);
}

}  // namespace dynlab::inline numerics
