#include "numerics/simulation/frequency_response.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/error.h"

namespace dynlab::inline numerics {

ComplexVector frequency_response(const TransferFunction& G, const VectorView& w) {
    if (!w.allFinite()) throw InvalidArgument("frequency response: the frequencies hold a value that is not finite");
    ComplexVector response(w.size());
    for (Index i = 0; i < w.size(); ++i)
        response(i) = G.at(G.continuous() ? Complex(0, w(i)) : std::polar(1.0, w(i) * G.Ts()));
    return response;
}

Vector magnitude_db(const ComplexVector& response) {
    return 20 * response.array().abs().log10();
}

Vector phase_degrees_unwrapped(const ComplexVector& response) {
    constexpr double kTurn = 360;
    Vector phase(response.size());
    for (Index i = 0; i < phase.size(); ++i) {
        phase(i) = std::arg(response(i)) * 180 / std::numbers::pi;
        if (i > 0) phase(i) -= kTurn * std::round((phase(i) - phase(i - 1)) / kTurn);
    }
    return phase;
}

Vector natural_frequency_grid(const TransferFunction& G, Index count) {
    if (count < 2)
        throw InvalidArgument("frequency grid: at least 2 points are needed, but " + std::to_string(count) +
                              " were asked for");
    constexpr double kDecadesBeyond = 1.5, kDecadesWithoutCorner = 2;
    const Vector corners = corner_frequencies(G);
    const double nyquist = G.continuous() ? 0 : std::numbers::pi / G.Ts();
    const double centre = !G.continuous() ? nyquist / 10 : G.delay() > 0 ? 1 / G.delay() : 1;
    double first = std::log10(centre) - kDecadesWithoutCorner, last = std::log10(centre) + kDecadesWithoutCorner;
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
