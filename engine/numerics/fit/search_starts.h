#pragma once
#include <functional>
#include <map>
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Additional starts of a joint search for the smallest simulation error: solutions of structures with fewer parameters,
// and solutions found after poles were exchanged for others.

/// The structures that are a step poorer than one with fixed delays: a pole less in every denominator that has two, a
/// zero less in every channel that has one, or both. Their models are limits of models of the structure.
std::vector<TransferStructure> lower_order_structures(const TransferStructure& structure);

/// theta for `structure` with nearly the output of `lower_order_theta` for a structure that is a step or more poorer:
/// missing poles and zeros are added at -fast (rad/s), those that a denominator and all its channels miss together
/// cancel at -middle. Where several are missing, each lies at 1.5 times the one before.
Vector enriched(const TransferStructure& lower_order, const Vector& lower_order_theta,
                const TransferStructure& structure, double fast, double middle);

/// Starts of the structure, with its free delays where theirs are, from the poorer fits whose loss is below `loss`.
std::vector<Vector> starts_from_lower_order(const IdData& data, const std::vector<const Fit*>& lower_order,
                                            const TransferStructure& structure, double loss);

/// Positions of added poles and zeros: five and a hundred times the mean sampling rate of the data. From the first a
/// search finds dynamics; at the second the loss is that of the model with fewer parameters. Canceling pairs lie half
/// way on a logarithmic scale from the slowest that the longest experiment shows.
class AddedRoots {
  public:
    explicit AddedRoots(const IdData& data);
    /// Starts of the structure from a solution of a poorer one.
    std::vector<Vector> starts(const TransferStructure& lower_order, const Vector& theta,
                               const TransferStructure& structure) const;

  private:
    double rate_, slowest_;  // rad/s
};

/// A solution, and what a search makes smaller.
struct NestedSolution {
    Vector theta = {};
    double loss = kInfinity;
    TransferStructure structure = {};  ///< of theta: a poorer one than asked for where nothing was gained on it
};

/// Finds solutions that are no worse than those of poorer structures, which are found in the same way first.
class NestedSearch {
  public:
    /// The solution for a structure with fixed delays, from these starts in addition to the method's.
    using Solve = std::function<NestedSolution(const TransferStructure&, const std::vector<Vector>& starts)>;

    NestedSearch(const IdData& data, Solve solve);

    /// Starts of the structure from poorer ones' solutions whose loss is below `loss`.
    std::vector<Vector> better_starts(const TransferStructure& structure, double loss);

  private:
    const NestedSolution& best(const TransferStructure& structure);

    Solve solve_;
    AddedRoots added_;
    std::map<std::vector<int>, NestedSolution> found_;  // by poles and zeros
};

/// theta with the poles of the monic A and this delay (s; where it is free), for one input and one output: numerator,
/// initial values and offset by least squares, and the loss. No theta where the simulation explodes.
NestedSolution with_linear_part(const IdData& data, const TransferStructure& structure, const StartCondition& condition,
                                const VectorView& A, double delay);

/// theta of models of one input and one output in which one or two poles of `found`, a fit of the structure, are
/// replaced: a real pole by others, the two slowest or the two fastest by a pair. The other parameters follow by least
/// squares. Pairs of damping 0.1 are tried at twelve frequencies over the band that the data can show; the valleys of
/// the loss over the frequency count, if below 1.2 times the loss of `found`. Pairs of damping 0.1 and 0.02 are tried
/// at the peaks of the measured frequency response (signals/response_peaks.h), with several delays if the delay is
/// free. Best first, at most four of each kind.
std::vector<Vector> exchanged_poles(const IdData& data, const TransferStructure& structure, const Fit& found,
                                    const FitOptions& options);

}  // namespace dynlab::inline numerics
