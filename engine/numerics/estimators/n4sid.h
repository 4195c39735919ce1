#pragma once
#include "numerics/fit/fit.h"
#include "numerics/models/state_space.h"

namespace dynlab::inline numerics {

/// How the directions of the state are weighed against the noise.
enum class SubspaceWeighting {
    kMoesp,  ///< "MOESP": by what they give to the future outputs (Verhaegen 1994)
    kN4sid,  ///< "N4SID": the same, future inputs left in (Van Overschee and De Moor 1994)
    kCva,    ///< "CVA": by their correlation with the future outputs (Larimore 1990)
};

struct SubspaceOptions {
    int block_rows = 0;  ///< s: samples of past and of future; 0 for 15, or 2 order if that is more, or what fits
    SubspaceWeighting weighting = SubspaceWeighting::kMoesp;
    bool feedthrough = false;  ///< D is estimated rather than zero

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// A fit with what no other method finds: states. It has no theta, and of the Fit these are given: models (ny nu of
/// them, output by output), fit_percent and loss of the simulation from the estimated initial states, condition_number
/// (of the column-scaled equations for B, D and the initial states), start, warnings and message.
struct SubspaceFit {
    Fit fit;
    StateSpace system;       ///< order n, ny outputs, nu inputs, discrete time
    Vector singular_values;  ///< s ny of them: a gap after the n-th speaks for order n
    Matrix initial_states;   ///< n x experiments
    int block_rows = 0;      ///< s
};

/// x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k) + v(k) by subspace identification, without iteration. With s block
/// rows, n4sid subtracts from the future outputs y(k)..y(k+s-1) the part that the future inputs explain, and regresses
/// the rest on the past inputs and outputs. One orthogonal triangularization of all of them solves this regression; its
/// memory does not grow with the length of the data. The n largest singular values of the regression, weighted
/// according to `weighting`, determine the extended observability matrix [C; C A; C A^2; ..], whose shift gives A and
/// C. B, D and the initial state of each experiment then follow by linear least squares on the simulated output.
/// Eigenvalues outside the unit circle are mirrored into it. The estimate is consistent for any stationary v that is
/// independent of the inputs, which must be rich enough for s. It is less precise than an output-error or
/// prediction-error estimate, for which it is a start without initial values. There are no standard errors. Outputs are
/// first scaled to equal size, so that their units do not matter. Data: any number of inputs, outputs and experiments,
/// regular sampling. Throws InvalidArgument for other data, an order below 1 or not below s, too few samples or an
/// input not persistently exciting enough for s. References: Verhaegen and Dewilde (1992); Verhaegen (1994), Automatica
/// 30, 61-74; Ljung (1999), section 10.6.
SubspaceFit n4sid(const IdData& data, int order, const SubspaceOptions& options = {});

}  // namespace dynlab::inline numerics
