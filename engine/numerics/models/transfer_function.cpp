#include "numerics/models/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

void check_coefficients(const VectorView& num, const VectorView& den) {
    if (num.size() == 0) throw InvalidArgument("transfer function: the numerator has no coefficients");
    if (!num.allFinite())
        throw InvalidArgument("transfer function: the numerator contains a coefficient that is not finite");
    if (den.size() == 0) throw InvalidArgument("transfer function: the denominator has no coefficients");
    if (!den.allFinite())
        throw InvalidArgument("transfer function: the denominator contains a coefficient that is not finite");
}

/// A discrete delay, rounded to the exact multiple of Ts.
double delay_on_grid(double delay, double Ts) {
    constexpr double kRounding = 1e-9;
    const double samples = delay / Ts, nearest = std::round(samples);
    if (std::abs(samples - nearest) > kRounding * std::max(1.0, nearest))
        throw InvalidArgument(
            "transfer function: in discrete time the delay must be a multiple of Ts = {} s, but it is {} s", Ts, delay);
    return nearest * Ts;
}

/// p at s = 0 or z = 1, where a step response ends: there a sum, which is zero when it is no more than the rounding of
/// its terms, as that of a sampled integrator.
double steady_value(const Vector& p, bool continuous) {
    if (continuous) return p[p.size() - 1];
    constexpr double kRounding = std::numeric_limits<double>::epsilon();
    const double sum = p.sum();
    return std::abs(sum) > static_cast<double>(p.size()) * kRounding * p.lpNorm<1>() ? sum : 0;
}

/// p(x)/(x - root)^k at the root 0 or 1, k being how often p has it: the sign of p just above.
double leading_value(Vector p, bool continuous) {
    while (p.size() > 1 && steady_value(p, continuous) == 0) {
        for (Index i = 1; !continuous && i < p.size(); ++i) p[i] += p[i - 1];  // Horner's scheme
        p.conservativeResize(p.size() - 1);
    }
    return steady_value(p, continuous);
}

bool is_gain(const TransferFunction& G) {
    return G.num().size() == 1 && G.den().size() == 1 && G.delay() == 0;
}

double common_sampling_time(const TransferFunction& a, const TransferFunction& b) {
    if (a.Ts() == b.Ts() || is_gain(b)) return a.Ts();
    if (is_gain(a)) return b.Ts();
    throw InvalidArgument(
        "transfer functions with the sampling times {} s and {} s cannot be combined (0 means continuous time). "
        "Convert one of them with c2d or d2c",
        a.Ts(), b.Ts());
}

/// The delay (s) of a discrete model beyond `kept` as poles at zero.
TransferFunction with_later_poles(const TransferFunction& G, double Ts, double kept) {
    const auto samples = static_cast<Index>(std::lround((G.delay() - kept) / Ts));
    return TransferFunction(G.num(), multiply(G.den(), Vector::Unit(samples + 1, 0)), Ts, kept);
}

}  // namespace

TransferFunction::TransferFunction(const VectorView& num, const VectorView& den, double Ts, double delay)
    : Ts_(Ts), delay_(delay) {
    check_coefficients(num, den);
    if (!(Ts >= 0) || !std::isfinite(Ts))
        throw InvalidArgument(
            "transfer function: Ts must be a positive number of seconds, or 0 for continuous time, but it is {}", Ts);
    if (!(delay >= 0) || !std::isfinite(delay))
        throw InvalidArgument("transfer function: the delay must be nonnegative, but it is {} s", delay);
    if (den.isZero(0)) throw InvalidArgument("transfer function: the denominator is zero");
    if (Ts > 0) delay_ = delay_on_grid(delay, Ts);
    const Vector stripped = strip_leading_zeros(den);
    den_ = stripped / stripped(0);
    num_ = strip_leading_zeros(num) / stripped(0);
}

TransferFunction TransferFunction::variable(double Ts) {
    return TransferFunction(Eigen::Vector2d(1, 0), Vector::Ones(1), Ts);
}

ComplexVector TransferFunction::poles() const {
    return roots(den_);
}

ComplexVector TransferFunction::zeros() const {
    return num_.isZero(0) ? ComplexVector() : roots(num_);
}

double TransferFunction::dc_gain() const {
    const double below = steady_value(den_, continuous()), above = steady_value(num_, continuous());
    if (below != 0) return above / below;
    if (above == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::copysign(std::numeric_limits<double>::infinity(), above * leading_value(den_, continuous()));
}

bool TransferFunction::stable() const {
    const ComplexVector all = poles();
    if (continuous()) return (all.real().array() < 0).all();
    return steady_value(den_, false) != 0 && (all.array().abs() < 1).all();
}

Complex TransferFunction::at(Complex point) const {
    const Complex rational = evaluate(num_, point) / evaluate(den_, point);
    if (delay_ == 0) return rational;
    return rational * (continuous() ? std::exp(-delay_ * point) : std::pow(point, -std::round(delay_ / Ts_)));
}

TransferFunction TransferFunction::with_delay(double delay) const {
    return TransferFunction(num_, den_, Ts_, delay);
}

TransferFunction operator+(const TransferFunction& a, const TransferFunction& b) {
    if (a.delay() != b.delay()) {
        const double Ts = common_sampling_time(a, b), common = std::min(a.delay(), b.delay());
        if (Ts > 0) return with_later_poles(a, Ts, common) + with_later_poles(b, Ts, common);
        throw InvalidArgument(
            "transfer functions with the delays {} s and {} s cannot be added: the sum is not a rational function. "
            "Approximate the delays with pade(G, n)",
            a.delay(), b.delay());
    }
    const Vector num = add(multiply(a.num(), b.den()), multiply(b.num(), a.den()));
    return TransferFunction(num, multiply(a.den(), b.den()), common_sampling_time(a, b), a.delay());
}

TransferFunction operator-(const TransferFunction& a, const TransferFunction& b) {
    return a + TransferFunction(-b.num(), b.den(), b.Ts(), b.delay());
}

TransferFunction operator*(const TransferFunction& a, const TransferFunction& b) {
    return TransferFunction(multiply(a.num(), b.num()), multiply(a.den(), b.den()), common_sampling_time(a, b),
                            a.delay() + b.delay());
}

TransferFunction operator/(const TransferFunction& a, const TransferFunction& b) {
    if (b.delay() > a.delay())
        throw InvalidArgument(
            "division of a transfer function with a delay of {} s by a transfer function with a delay of {} s: the "
            "quotient would not be causal",
            a.delay(), b.delay());
    if (b.num().isZero(0)) throw InvalidArgument("division by a zero transfer function");
    return a.with_delay(a.delay() - b.delay()) * TransferFunction(b.den(), b.num(), b.Ts());
}

TransferFunction pow(const TransferFunction& base, int exponent) {
    if (exponent < 0) return TransferFunction() / pow(base, -exponent);
    return TransferFunction(power(base.num(), exponent), power(base.den(), exponent), base.Ts(),
                            exponent * base.delay());
}

TransferFunction feedback(const TransferFunction& forward, const TransferFunction& backward, int sign) {
    if (forward.delay() > 0 || backward.delay() > 0)
        throw InvalidArgument(
            "feedback: a closed loop with a delay has no rational transfer function: approximate the delay with "
            "pade(G, n), or convert the models to discrete time with c2d(G, Ts)");
    const double Ts = common_sampling_time(forward, backward);
    const Vector loop = multiply(forward.num(), backward.num());
    const Vector den = add(multiply(forward.den(), backward.den()), sign > 0 ? Vector(-loop) : loop);
    if (den.isZero(0))
        throw InvalidArgument(
            "feedback: the closed loop is not well-posed, because its denominator is zero at all frequencies");
    return TransferFunction(multiply(forward.num(), backward.den()), den, Ts);
}

}  // namespace dynlab::inline numerics
