#include "numerics/fit/frequency_start.h"

#include <cmath>
#include <numbers>

#include "numerics/criteria/frequency_output.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kHighestOfHold = 0.7;  // of pi/Ts
constexpr Complex kImaginary{0, 1};

/// What a hold makes of a sine, as seen at its own frequency.
Complex hold_response(InterSample inter_sample, double angle) {
    if (inter_sample == InterSample::kBandLimited) return 1;
    const double half = angle / 2, sinc = std::sin(half) / half;
    return inter_sample == InterSample::kZoh ? sinc * std::polar(1.0, -half) : Complex(sinc * sinc);
}

/// Lines that the equations use: all, unless a hold repeats the spectrum.
Index used_count(const FrequencyData& data) {
    if (data.inter_sample == InterSample::kBandLimited) return data.w.size();
    const double end = kHighestOfHold * std::numbers::pi / data.Ts;
    const Index below = (data.w.array() <= end).count();
    return 2 * below >= data.w.size() ? below : data.w.size();
}

Vector value_sizes(const VectorView& p, const ComplexVector& s) {
    Vector sizes(s.size());
    for (Index k = 0; k < s.size(); ++k) sizes[k] = std::abs(evaluate(p, s[k]));
    return sizes;
}

double squared_errors(const EquationLines& lines, const Vector& coefficients, Index poles) {
    const Vector F = monic(coefficients.head(poles)), B = coefficients.tail(coefficients.size() - poles);
    double sum = 0;
    for (Index k = 0; k < lines.s.size(); ++k)
        sum += std::pow(lines.weights[k], 2) *
               std::norm(lines.response[k] - evaluate(B, lines.s[k]) / evaluate(F, lines.s[k]));
    return sum;
}

}  // namespace

EquationLines equation_lines(const FrequencyData& data, double delay) {
    const Index count = used_count(data);
    EquationLines lines{kImaginary * frequency_time_unit(data) * data.w.head(count).cast<Complex>(),
                        data.response.head(count), response_weights(data).head(count)};
    for (Index k = 0; k < count; ++k) {
        const Complex hold = hold_response(data.inter_sample, data.w[k] * data.Ts);
        lines.response[k] *= std::polar(1.0, data.w[k] * delay) / hold;
        lines.weights[k] *= std::abs(hold);
    }
    return lines;
}

Vector equation_solution(const EquationLines& lines, const VectorView& sizes, Index poles, Index zeros) {
    const Index K = lines.s.size(), count = poles + zeros + 1;
    const Vector weights = lines.weights.cwiseQuotient(sizes.cwiseMax(1e-12 * sizes.maxCoeff()));
    const RationalBasis basis =
        rational_basis(lines.s, weights.cwiseProduct(lines.response.cwiseAbs()), weights, poles, zeros);
    Eigen::MatrixXcd equations(K, count + 1);
    equations << (-lines.response).asDiagonal() * basis.P.leftCols(poles), basis.Q,
        lines.response.cwiseProduct(basis.P.col(poles));
    equations = weights.cast<Complex>().asDiagonal() * equations;
    Matrix rows(2 * K, count + 1);
    rows << equations.real(), equations.imag();
    return basis.coefficients(solve_least_squares(rows.leftCols(count), rows.col(count)).solution);
}

FrequencyStart sanathanan_koerner(const EquationLines& lines, Index poles, Index zeros, int passes) {
    constexpr double kSettled = 1e-8;
    const Vector first{{1.0, 1.0}};
    Vector sizes = value_sizes(power(first, static_cast<int>(poles)), lines.s), before;
    FrequencyStart best{Vector(), kInfinity};
    for (int pass = 0; pass < passes; ++pass) {
        const Vector found = equation_solution(lines, sizes, poles, zeros);
        if (!found.allFinite()) break;
        const double squares = squared_errors(lines, found, poles);
        if (best.coefficients.size() == 0 || squares < best.squares) best = {found, squares};
        if (before.size() > 0 && (found - before).norm() <= kSettled * found.norm()) break;
        before = found;
        sizes = value_sizes(monic(found.head(poles)), lines.s);
    }
    return best;
}

Vector with_stable_poles(const VectorView& coefficients, Index poles) {
    ComplexVector places = roots(monic(coefficients.head(poles)));
    for (Complex& place : places) place.real(-std::abs(place.real()));
    Vector mirrored = coefficients;
    mirrored.head(poles) = polynomial_from_roots(places).tail(poles);
    return mirrored;
}

}  // namespace dynlab::inline numerics
