#include "numerics/models/convert.h"

#include <cmath>
#include <string>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"
#include "numerics/signals/checks.h"

namespace dynlab::inline numerics {

namespace {

void check_convertible(const std::string& caller, const TransferFunction& G) {
    if (G.proper()) return;
    throw InvalidArgument("{}: the transfer function has {} but only {}; it needs at least as many poles as zeros",
                          caller, plural(G.zero_count(), "{} zero", "{} zeros"),
                          plural(G.pole_count(), "{} pole", "{} poles"));
}

Hold hold_of(Discretization method) {
    return method == Discretization::kFoh ? Hold::kFoh : Hold::kZoh;
}

/// The numerators over `den` (of degree n = order, or n + 1 with a factor z for a tap on the previous sample) of all
/// outputs, one column each: den times the response to a single sample of one.
Matrix discrete_numerators(const SampledSystem& system, const Vector& den) {
    Matrix response(den.size(), system.C.rows());
    Vector x = system.G.col(0);
    for (Index k = 0; k < den.size(); ++k) {
        response.row(k) = system.C * x;
        if (k < 2) response.row(k) += system.D.col(k).transpose();
        x = system.F * x;
        if (k < 2) x += system.G.col(k + 1);
    }
    Matrix numerators = Matrix::Zero(den.size(), system.C.rows());
    for (Index i = 0; i < den.size(); ++i)
        numerators.bottomRows(den.size() - i) += den(i) * response.topRows(den.size() - i);
    return numerators;
}

TransferFunction exact_c2d(const TransferFunction& G, double Ts, Hold hold) {
    const StateSpace form = to_state_space(G);
    const auto [samples, rest] = split_delay(G.delay(), Ts);
    const SampledSystem system = discretize(form.A, form.B.col(0), form.C, form.D.col(0), Ts, hold, G.delay());
    Vector den = polynomial_from_roots((Ts * G.poles()).array().exp().matrix());
    if (rest > 0) den = multiply(den, Eigen::Vector2d(1, 0));
    return TransferFunction(discrete_numerators(system, den).col(0), den, Ts, static_cast<double>(samples) * Ts);
}

/// bottom(x)^degree p(top(x)/bottom(x)), a polynomial of that degree.
Vector substitute(const Vector& p, const Vector& top, const Vector& bottom, Index degree) {
    Vector result = Vector::Zero(1);
    for (Index i = 0; i < p.size(); ++i) {
        const int exponent = static_cast<int>(p.size() - 1 - i);
        const Vector term = multiply(power(top, exponent), power(bottom, static_cast<int>(degree) - exponent));
        result = add(result, p(i) * term);
    }
    return result;
}

/// Whether p(x) is zero but for rounding.
bool has_root(const Vector& p, double x) {
    constexpr double kRounding = 1e-14;
    return std::abs(evaluate(p, x)) <= kRounding * evaluate(p.cwiseAbs(), std::abs(x));
}

[[noreturn]] void report_pole_without_image(double Ts) {
    throw InvalidArgument("c2d: the Tustin method is undefined for a pole at 2/Ts = {} rad/s; choose another Ts",
                          2 / Ts);
}

TransferFunction tustin_c2d(const TransferFunction& G, double Ts) {
    if (split_delay(G.delay(), Ts).rest > 0)
        throw InvalidArgument(
            "c2d: the Tustin method needs a delay that is a multiple of Ts = {} s, but it is {} s; zoh and foh support "
            "any delay",
            Ts, G.delay());
    const Vector top = 2 / Ts * Eigen::Vector2d(1, -1), bottom = Eigen::Vector2d(1, 1);
    if (has_root(G.den(), 2 / Ts)) report_pole_without_image(Ts);
    const Vector den = substitute(G.den(), top, bottom, G.pole_count());
    const double delay = static_cast<double>(split_delay(G.delay(), Ts).samples) * Ts;
    return TransferFunction(substitute(G.num(), top, bottom, G.pole_count()), den, Ts, delay);
}

/// Leading coefficients that are only rounding of the others become zero.
Vector without_rounding(Vector num) {
    constexpr double kRounding = 1e-11;
    const double largest = num.cwiseAbs().maxCoeff();
    for (double& coefficient : num) {
        if (std::abs(coefficient) > kRounding * largest) break;
        coefficient = 0;
    }
    return num;
}

/// From time in samples to time in seconds: s becomes s Ts.
Vector in_seconds(const Vector& p, double Ts) {
    Vector scaled = p;
    double factor = 1;
    for (Index i = p.size(); i-- > 0; factor *= Ts) scaled(i) *= factor;
    return scaled;
}

TransferFunction exact_d2c(const TransferFunction& G, Hold hold) {
    const ComplexVector discrete_poles = G.poles();
    for (const Complex& pole : discrete_poles)
        if (pole.imag() == 0 && pole.real() <= 0)
            throw InvalidArgument(
                "d2c: the pole z = {} has no equivalent in a continuous-time model of the same order. With zoh and "
                "foh, no pole may be at zero or on the negative real axis. Noise or too many poles can cause this pole",
                pole.real());
    // The discrete numerator is linear in the continuous one: solve for its coefficients, with time in samples.
    const Vector den = polynomial_from_roots(discrete_poles.array().log().matrix());
    const Matrix map = discrete_numerators(derivative_filter(den, 1, hold), G.den());
    Vector requested = Vector::Zero(G.den().size());
    requested.tail(G.num().size()) = G.num();
    const Vector num = without_rounding(minimum_norm_solution(map, requested));
    return TransferFunction(in_seconds(num, G.Ts()), in_seconds(den, G.Ts()), 0, G.delay());
}

TransferFunction tustin_d2c(const TransferFunction& G) {
    const Vector top = Eigen::Vector2d(1, 2), bottom = Eigen::Vector2d(-1, 2);  // z, with time in samples
    if (has_root(G.den(), -1)) throw InvalidArgument("d2c: the Tustin method is undefined for a pole at z = -1");
    const Vector den = substitute(G.den(), top, bottom, G.pole_count());
    const Vector num = without_rounding(substitute(G.num(), top, bottom, G.pole_count()));
    return TransferFunction(in_seconds(num, G.Ts()), in_seconds(den, G.Ts()), 0, G.delay());
}

}  // namespace

TransferFunction c2d(const TransferFunction& G, double Ts, Discretization method) {
    if (!G.continuous())
        throw InvalidArgument("c2d: the model is already a discrete-time model, with Ts = {} s", G.Ts());
    check_sampling_time("c2d", Ts);
    check_convertible("c2d", G);
    return method == Discretization::kTustin ? tustin_c2d(G, Ts) : exact_c2d(G, Ts, hold_of(method));
}

StateSpace c2d(const StateSpace& system, double Ts, Discretization method) {
    if (system.Ts > 0)
        throw InvalidArgument("c2d: the model is already a discrete-time model, with Ts = {} s", system.Ts);
    check_sampling_time("c2d", Ts);
    const Matrix &A = system.A, &B = system.B, &C = system.C;
    if (method == Discretization::kTustin) {
        const Matrix I = Matrix::Identity(A.rows(), A.rows());
        const Matrix back = I - Ts / 2 * A;
        // Compared with the two terms of the difference, which leave rounding errors where they cancel.
        const double rounding = 1e-14 * (1 + Ts / 2 * A.norm());
        if (A.rows() > 0 && singular_values(back).minCoeff() <= rounding) report_pole_without_image(Ts);
        const Matrix inverse = solve_by_lu(back, I).x;
        return StateSpace(inverse * (I + Ts / 2 * A), Ts * inverse * B, C * inverse,
                          system.D + Ts / 2 * C * inverse * B, Ts);
    }
    const StepMatrices step = exact_step(A, B, Ts);
    if (method == Discretization::kZoh) return StateSpace(step.F, step.G, C, system.D, Ts);
    // x[k+1] = F x[k] + H0 u[k] + H1 u[k+1] with the state x - H1 u, which needs no input of the future.
    return StateSpace(step.F, step.H0 + step.F * step.H1, C, system.D + C * step.H1, Ts);
}

TransferFunction d2c(const TransferFunction& G, Discretization method) {
    if (G.continuous()) throw InvalidArgument("d2c: the model is already a continuous-time model");
    check_convertible("d2c", G);
    return method == Discretization::kTustin ? tustin_d2c(G) : exact_d2c(G, hold_of(method));
}

TransferFunction with_rational_delay(const std::string& caller, const TransferFunction& G) {
    if (G.delay() == 0) return G;
    if (G.continuous())
        throw InvalidArgument(
            "{}: a model with a delay of {} s has no rational transfer function: approximate the delay with pade(G, "
            "n), or use c2d(G, Ts), which is exact at the sampling instants",
            caller, G.delay());
    const auto samples = static_cast<Index>(std::lround(G.delay() / G.Ts()));
    return TransferFunction(G.num(), multiply(G.den(), Vector::Unit(samples + 1, 0)), G.Ts());
}

TransferFunction pade(const TransferFunction& G, int order) {
    if (order < 1 || order > 10) throw InvalidArgument("pade: the order must be between 1 and 10, but is {}", order);
    if (G.delay() == 0 || !G.continuous()) return with_rational_delay("pade", G);
    // P(s) = sum_k c_k (delay s)^k with c_0 = 1, c_k/c_(k-1) = (order - k + 1)/((2 order - k + 1) k), highest power
    // first
    Vector P(order + 1), mirrored(order + 1);
    double c = 1;
    for (int k = 0; k <= order; ++k) {
        if (k > 0) c *= G.delay() * (order - k + 1) / ((2 * order - k + 1) * k);
        P[order - k] = c;
        mirrored[order - k] = k % 2 == 0 ? c : -c;
    }
    return TransferFunction(multiply(G.num(), mirrored), multiply(G.den(), P));
}

}  // namespace dynlab::inline numerics
