#pragma once
#include <functional>
#include <map>
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

// Where a joint search for the smallest simulation error begins: on a curve over the delay, and at solutions of poorer
// structures.

/// The smallest mean square simulation error found at each delay, and where a joint search begins.
struct DelayScan {
    Vector delays, losses;       ///< s in rising order, and the mean square errors
    std::vector<Vector> starts;  ///< theta with the delay, of the lowest valleys of the curve, best first
    double largest = 0;          ///< s; delays up to here were tried
};

/// The largest delay worth looking at first: where the correlation of the input with later output has its peak, and a
/// bit more; at least a few samples, at most a quarter of the shortest record. The quarter itself for inputs that
/// change three times or less, whose correlation tells nothing of the delay.
double likely_largest_delay(const IdData& data);

/// theta of fixed delays with the delays put in their places.
Vector with_delays(const TransferStructure& free, const TransferStructure& at, const Vector& theta);

/// The structure with its delays fixed where their search begins.
TransferStructure with_fixed_delays(TransferStructure structure);

/// theta where a search begins: options.lambda's first estimate or the best of several cut-off frequencies.
Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options);

/// Loss over the delay of every channel in turn (the others as found so far), zero state and no offset, in at most
/// delay_count steps of at least one mean sampling time, and no more than two samples apart near the lowest valleys.
/// Every delay is fitted from its neighbours' solutions on both sides, some from filtered starts too, so that the curve
/// is the lower envelope of what was found. Unless the options give the largest delay, the range grows while the curve
/// is lowest at its end, up to a quarter of the shortest record. Of longer records the first 50,000 samples are looked
/// at. The curve is the last channel's.
DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options);

/// The structures that are a step poorer than one with fixed delays: a pole less in every denominator that has two, a
/// zero less in every channel that has one, or both. Their models are limits of models of the structure.
std::vector<TransferStructure> poorer_structures(const TransferStructure& structure);

/// theta for `structure` with nearly the output of `poorer_theta` for a structure that is a step or more poorer:
/// missing poles and zeros are added at -fast (rad/s), those that a denominator and all its channels miss together
/// cancel at -middle. Where several are missing, each lies at 1.5 times the one before.
Vector enriched(const TransferStructure& poorer, const Vector& poorer_theta, const TransferStructure& structure,
                double fast, double middle);

/// A solution, and what a search makes smaller.
struct NestedSolution {
    Vector theta = {};
    double loss = kInfinity;
    TransferStructure structure = {};  ///< of theta: a poorer one than asked for where nothing was gained on it
};

/// Finds solutions that are no worse than those of poorer structures, which are found in the same way first.
class NestedSearch {
  public:
    /// The solution for a structure with fixed delays, from these starts besides the method's own.
    using Solve = std::function<NestedSolution(const TransferStructure&, const std::vector<Vector>& starts)>;

    /// Roots are added at five and at a hundred times the mean sampling rate of the data: from the first a search finds
    /// dynamics, at the second the loss is the poorer model's. The middle lies half way on a logarithmic scale from the
    /// slowest that the longest record shows.
    NestedSearch(const IdData& data, Solve solve);

    /// Starts of the structure from poorer ones' solutions whose loss is below `loss`.
    std::vector<Vector> better_starts(const TransferStructure& structure, double loss);

  private:
    const NestedSolution& best(const TransferStructure& structure);

    Solve solve_;
    double rate_, slowest_;                             // rad/s
    std::map<std::vector<int>, NestedSolution> found_;  // by poles and zeros
};

}  // namespace dynlab::inline numerics
