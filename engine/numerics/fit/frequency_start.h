#pragma once
#include "numerics/models/frequency_data.h"

namespace dynlab::inline numerics {

/// A measured response as the equations F G = B see it: points s = i w in 1/time unit, without the delay and without
/// what a hold does below pi/Ts, of which the lines are left out that lie so high that its repetitions matter.
struct EquationLines {
    ComplexVector s, response;
    Vector weights;  ///< of the real and imaginary part of the response
};
/// The delay in seconds.
EquationLines equation_lines(const FrequencyData& data, double delay);

/// B/F that minimizes sum_k weight_k^2 |F(s_k) G_k - B(s_k)|^2/|size_k|^2, F monic: [a_1 .. a_n b_0 .. b_m], in the
/// time units of the lines. `sizes` (K) are what the equation of each line is divided by. Polynomials that are
/// orthogonal on the lines keep it accurate over many decades. Throws InvalidArgument for fewer lines than the degrees
/// need. Reference: Levy (1959).
Vector equation_solution(const EquationLines& lines, const VectorView& sizes, Index poles, Index zeros);

/// The same again and again, divided by the F of the pass before, so that errors count as those of the response do: the
/// pass of smallest error sum_k weight_k^2 |G_k - B/F|^2. `passes` at most; the first is divided by |s + 1|^n.
/// Reference: Sanathanan and Koerner (1963).
struct FrequencyStart {
    Vector coefficients;
    double squares = 0;
};
FrequencyStart sanathanan_koerner(const EquationLines& lines, Index poles, Index zeros, int passes);

/// Those coefficients with poles to the right of the imaginary axis mirrored.
Vector with_stable_poles(const VectorView& coefficients, Index poles);

}  // namespace dynlab::inline numerics
