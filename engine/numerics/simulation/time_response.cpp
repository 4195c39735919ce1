#include "numerics/simulation/time_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "numerics/error.h"
#include "numerics/signals/checks.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::inline numerics {

namespace {

void check_response_times(const std::string& caller, const VectorView& t) {
    if (t.size() == 0) throw InvalidArgument("{}: the time vector is empty", caller);
    check_instants(caller, t);
    if (t(0) < 0) throw InvalidArgument("{}: the response starts at time 0, but the first instant is {}", caller, t(0));
}

/// The instants of a discrete response as numbers of samples.
Eigen::VectorX<Index> sample_numbers(const std::string& caller, const VectorView& t, double Ts) {
    constexpr double kRounding = 1e-6;
    Eigen::VectorX<Index> numbers(t.size());
    for (Index i = 0; i < t.size(); ++i) {
        const double samples = t(i) / Ts;
        numbers(i) = std::llround(samples);
        if (std::abs(samples - static_cast<double>(numbers(i))) > kRounding)
            throw InvalidArgument(
                "{}: the model is a discrete-time model, so the instants must be multiples of Ts = {} s, but instant "
                "{} is {} s",
                caller, Ts, i + 1, t(i));
    }
    return numbers;
}

/// The response to `first` at sample 0 and `later` at the following ones.
Vector discrete_response(const std::string& caller, const TransferFunction& G, const VectorView& t, double first,
                         double later) {
    const Eigen::VectorX<Index> samples = sample_numbers(caller, t, G.Ts());
    Vector u = Vector::Constant(samples(samples.size() - 1) + 1, later);
    u(0) = first;
    return lsim(G, u, G.Ts())(samples);
}

/// Continuous G at instants that need not begin at zero: state x0 and a constant input from time zero on.
Vector response_from_zero(const TransferFunction& G, const VectorView& t, double input, const VectorView& x0) {
    const Index extra = t(0) > 0 ? 1 : 0;
    Vector instants = Vector::Zero(t.size() + extra);
    instants.tail(t.size()) = t;
    const Vector u = Vector::Constant(instants.size(), input);
    return lsim(G, u, instants, Hold::kZoh, x0).tail(t.size());
}

/// The time window that shows a pole's complete part of the response, in seconds; 0 for a pole without a time constant
/// or period (an integrator).
double window(const PoleDescription& row) {
    constexpr double kSettled = 5 / 0.8, kGrown = 5, kPeriods = 10;  // time constants, time constants, periods
    if (std::isfinite(row.time_constant))
        return row.time_constant > 0 ? kSettled * row.time_constant : -kGrown * row.time_constant;
    return row.natural_frequency > 0 ? kPeriods * 2 * std::numbers::pi / row.natural_frequency : 0;
}

double round_up(double value) {
    constexpr std::array<double, 9> kRoundNumbers = {1, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double number : kRoundNumbers)
        if (value <= number * decade * (1 + 1e-9)) return number * decade;
    return 10 * decade;
}

double natural_duration(const TransferFunction& G) {
    double settled = 0, grown = 0;
    for (const PoleDescription& row : damping(G)) {
        double& longest = row.time_constant < 0 ? grown : settled;
        longest = std::max(longest, window(row));
    }
    double duration = grown > 0 ? grown : settled;
    if (duration == 0) duration = !G.continuous() ? 10 * G.Ts() : G.delay() > 0 ? G.delay() : 10;
    return round_up(duration + G.delay());
}

}  // namespace

TimeResponse step_response(const TransferFunction& G, const VectorView& t) {
    check_response_times("step", t);
    if (!G.continuous()) return {t, discrete_response("step", G, t, 1, 1)};
    return {t, response_from_zero(G, t, 1, Vector())};
}

TimeResponse impulse_response(const TransferFunction& G, const VectorView& t) {
    check_response_times("impulse", t);
    if (!G.continuous()) return {t, discrete_response("impulse", G, t, 1 / G.Ts(), 0)};
    // The impulse moves the state of the canonical form from zero to its first unit vector.
    const Index before = (t.array() < G.delay()).count(), after = t.size() - before;
    Vector y = Vector::Zero(t.size());
    const Vector impulse_state = G.pole_count() > 0 ? Vector(Vector::Unit(G.pole_count(), 0)) : Vector();
    if (after > 0)
        y.tail(after) = response_from_zero(G.with_delay(0), t.tail(after).array() - G.delay(), 0, impulse_state);
    return {t, y};
}

Vector natural_time_grid(const TransferFunction& G, Index count) {
    if (count < 2) throw InvalidArgument("time grid: the number of instants must be at least 2, but is {}", count);
    const double duration = natural_duration(G);
    if (G.continuous()) return Vector::LinSpaced(count, 0, duration);
    constexpr double kMaxSamples = 1e4, kMinSamples = 10;
    const double samples = std::clamp(std::ceil(duration / G.Ts()), kMinSamples, kMaxSamples - 1);
    return G.Ts() * Vector::LinSpaced(static_cast<Index>(samples) + 1, 0, samples);
}

}  // namespace dynlab::inline numerics
