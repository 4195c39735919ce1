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
/// with f on straight lines between its values at the edges of bins, and constant beyond them. With f = sum c_i phi_i
/// (phi_i the hat functions of the edges) the model is linear in f: coe of the inputs phi_i(u) with one denominator
/// gives a start without a guess, from which the closest product c_i b_j follows (Bai 1998); then A, B, the c_i and the
/// delay minimize sum e^2 together, by damped Gauss-Newton with exact sensitivities. The delay starts where the linear
/// model has it. Exact for held inputs, of which f(u) is held too. Errors of white measurement noise give the right
/// covariance; nothing need be known of f, which tells a dead band, a saturation or unequal gains. Edges whose
/// surroundings the input hardly visits are left out, with a warning, and an input of no more values than there are
/// edges (a square wave) has its values as edges, with another. Data: one input, held, and one output; any number of
/// experiments. Throws InvalidArgument for other data or options (check_transfer_data), a free delay beyond the record,
/// or fewer than two edges that the input visits. Non-convergence and doubtful results are told in `warnings`.
/// Reference: Bai (1998), Automatica 34, 333-338; Giri and Bai (2010), Block-oriented Nonlinear System Identification.
Fit hammerstein(const IdData& data, const TransferStructure& structure, const HammersteinOptions& options = {});

/// The hat functions of the edges at each value of u (N x K): 1 at the edge, 0 at its neighbors and beyond, on
/// straight lines between; constant outside. Their sum is 1, and their product with `levels` is f(u).
Matrix hat_functions(const VectorView& edges, const VectorView& u);

}  // namespace dynlab::inline numerics
