#include "numerics/simulation/frequency_response.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kTurn = 360, kDegrees = 180 / std::numbers::pi;
constexpr double kOnTheEdge = 1e-10;  // relative: roots there are rounded ones of the stability limit

/// The angle of 1 - jw/root, in radians, from 0 at w = 0 on.
double angle_of_root(Complex root, double w) {
    if (std::abs(root) == 0) return std::numbers::pi / 2;
    if (std::abs(root.real()) > kOnTheEdge * std::abs(root)) return std::arg(1.0 - Complex(0, w) / root);
    return root.imag() > 0 && w > root.imag() ? std::numbers::pi : 0;
}

/// The same of z - root at z = exp(j turn), but for the sign of a real root outside the unit circle.
double angle_of_discrete_root(Complex root, double turn) {
    const Complex z = std::polar(1.0, turn);
    const double size = std::abs(root);
    if (size > 1 + kOnTheEdge) return std::arg(1.0 - z / root);
    if (size < 1 - kOnTheEdge) return turn + std::arg(1.0 - root / z);
    // On the circle the half turn comes where z passes the root.
    const double at = std::arg(root);
    return (turn + at) / 2 + (turn >= at ? 1 : -1) * std::numbers::pi / 2;
}

/// -1 for each real root behind which z - root or s - root is negative at zero frequency.
double sign_at_zero(const ComplexVector& roots, bool continuous) {
    double sign = 1;
    for (const Complex root : roots)
        if (root.imag() == 0 && root.real() > (continuous ? kOnTheEdge * std::abs(root) : 1 + kOnTheEdge)) sign = -sign;
    return sign;
}

}  // namespace

ComplexVector frequency_response(const TransferFunction& G, const VectorView& w) {
    if (!w.allFinite()) throw InvalidArgument("frequency response: the frequencies contain a value that is not finite");
    ComplexVector response(w.size());
    for (Index i = 0; i < w.size(); ++i)
        response(i) = G.at(G.continuous() ? Complex(0, w(i)) : std::polar(1.0, w(i) * G.Ts()));
    return response;
}

Vector magnitude_db(const ComplexVector& response) {
    return 20 * response.array().abs().log10();
}

Vector phase_degrees_unwrapped(const ComplexVector& response) {
    Vector phase(response.size());
    for (Index i = 0; i < phase.size(); ++i) {
        phase(i) = std::arg(response(i)) * kDegrees;
        if (i > 0) phase(i) -= kTurn * std::round((phase(i) - phase(i - 1)) / kTurn);
    }
    return phase;
}

Vector phase_degrees_unwrapped(const ComplexVector& response, const VectorView& w, double delay) {
    ComplexVector rest(response.size());
    for (Index i = 0; i < rest.size(); ++i) rest[i] = response[i] * std::polar(1.0, w[i] * delay);
    return phase_degrees_unwrapped(rest) - kDegrees * delay * w;
}

Vector phase_degrees(const TransferFunction& G, const VectorView& w) {
    const ComplexVector zeros = G.zeros(), poles = G.poles();
    const bool negative =
        (G.num()[0] < 0) != (sign_at_zero(zeros, G.continuous()) * sign_at_zero(poles, G.continuous()) < 0);
    const TransferFunction rational(G.num(), G.den(), G.Ts());
    const ComplexVector response = frequency_response(rational, w);
    Vector phase(w.size());
    for (Index i = 0; i < w.size(); ++i) {
        const auto angle = [&](const ComplexVector& roots) {
            double sum = 0;
            for (const Complex root : roots)
                sum += G.continuous() ? angle_of_root(root, w[i]) : angle_of_discrete_root(root, w[i] * G.Ts());
            return sum;
        };
        // The roots determine the number of turns, the response the exact angle.
        const double turned = kDegrees * (angle(zeros) - angle(poles)) + (negative ? kTurn / 2 : 0);
        const double exact = kDegrees * std::arg(response[i]);
        phase[i] = exact + kTurn * std::round((turned - exact) / kTurn) - kDegrees * w[i] * G.delay();
    }
    return phase;
}

Vector natural_frequency_grid(const TransferFunction& G, Index count) {
    if (count < 2) throw InvalidArgument("frequency grid: the number of points must be at least 2, but is {}", count);
    constexpr double kDecadesBeyond = 1.5, kDecadesWithoutCorner = 2;
    const Vector corners = corner_frequencies(G);
    const double nyquist = G.continuous() ? 0 : std::numbers::pi / G.Ts();
    const double center = !G.continuous() ? nyquist / 10 : G.delay() > 0 ? 1 / G.delay() : 1;
    double first = std::log10(center) - kDecadesWithoutCorner, last = std::log10(center) + kDecadesWithoutCorner;
    if (corners.size() > 0) {
        first = std::log10(corners(0)) - kDecadesBeyond;
        last = std::log10(corners(corners.size() - 1)) + kDecadesBeyond;
    }
    if (!G.continuous()) {
        last = std::log10(nyquist);
        first = std::min(first, last - kDecadesBeyond);
    }
    Vector grid(count);
    for (Index i = 0; i < count; ++i)
        grid(i) = std::pow(10, first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1));
    if (!G.continuous()) grid(count - 1) = nyquist;
    return grid;
}

}  // namespace dynlab::inline numerics
