#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Options of the linear part, of which initial_state may be kZero, kSteady or kAuto (the one of these that leaves
/// less) and offset must be kNone (a constant is part of the static characteristic); lambda and delays as for srivc.
struct HammersteinOptions : FitOptions {
    int bins = 10;       ///< equal bins between the smallest and the largest input
    Vector breakpoints;  ///< the bins' edges (increasing, two at least), when given instead of `bins`

    HammersteinOptions() {
        initial_state = InitialState::kAuto;
        offset = Offset::kNone;
    }
    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// Hammerstein model: a static characteristic f and then linear dynamics of steady-state gain one,
///     y(t) = B(p)/A(p) f(u(t - delay)) + e,   B(0) = A(0),
/// where f interpolates linearly between its values at the edges of bins and is constant beyond them. With f = sum c_i
/// phi_i (phi_i: hat functions of the edges) the model is linear in f: coe with the inputs phi_i(u) and one denominator
/// provides the start, from which the closest product c_i b_j follows (Bai 1998). Damped Gauss-Newton with exact
/// sensitivities then minimizes sum e^2 over A, B, the c_i and the delay. The delay starts at that of the linear model.
/// The model is exact for held inputs, for which f(u) is held too. For white measurement noise the covariance is
/// correct. No prior knowledge of f is needed; its estimate shows a dead band, a saturation or unequal gains. Edges
/// with too few input samples nearby are left out, with a warning. If the input takes no more values than there are
/// edges (a square wave), these values become the edges, with another warning. Data: one input, held, and one output;
/// any number of experiments. `warnings` reports non-convergence and doubtful results. Throws InvalidArgument for other
/// data or options (check_transfer_data), a free delay longer than the data, or fewer than two edges with input samples
/// nearby. References: Bai (1998), Automatica 34, 333-338; Giri and Bai (2010), Block-oriented Nonlinear System
/// Identification.
Fit hammerstein(const IdData& data, const TransferStructure& structure, const HammersteinOptions& options = {});

/// The hat functions of the edges at each value of u (N x K): 1 at the edge, 0 at its neighbors and beyond, linearly
/// interpolated between them; constant outside. Their sum is 1, and their product with `levels` is f(u).
Matrix hat_functions(const VectorView& edges, const VectorView& u);

}  // namespace dynlab::inline numerics
