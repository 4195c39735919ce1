#pragma once
#include <optional>
#include <vector>

#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// The part of a record that start values are looked for on: its beginning, so that it starts from rest as the whole.
IdData beginning_of(const IdData& data, Index most_samples);

struct SrivcSolution {
    Vector theta;
    Termination termination = Termination::kIterationLimit;
    std::vector<FitIteration> trace;  ///< without losses, which would cost a pass each
    bool mirrored = false;            ///< unstable poles were met on the way
    std::optional<double> loss;       ///< simulation_loss of theta, where the passes had to know it
    /// With SrivcExtras::with_gram, sum z z' of the last pass, each group's block on the diagonal: at the theta
    /// before the last change.
    Matrix gram;
};

struct SrivcExtras {
    Vector weights = {};  ///< of the outputs' squares where outputs share a denominator; ones when empty
    bool with_gram = false;
};

/// The iteration of SRIVC for fixed delays, from rest: in every pass each denominator group solves
///     sum_k z(k) (p^n y_f - phi' theta) = 0,
/// signals filtered by 1/A of the pass before, z the exact sensitivities of the simulated output; unstable poles are
/// mirrored. Where channels of one output have different denominators, each group explains what the others leave over
/// (back-fitting). It has converged when no parameter changes by more than tolerance of itself, judged before poles are
/// mirrored, or when all changes still to come are no more than that: they shrink by a nearly constant factor, taken
/// from the last two, but no less than 1/20. A pass that hardly gains on the one before it and raises the loss is
/// shortened. Without convergence the pass of smallest loss is given.
SrivcSolution iterate_srivc(const IdData& data, const TransferStructure& structure, const Vector& start,
                            const FitOptions& options, const SrivcExtras& extras = {});

/// The loss of a solution, which is not simulated again where it is known.
double simulation_loss(const IdData& data, const TransferStructure& structure, const SrivcSolution& solution);
/// Mean square of the simulation error from rest over all outputs; infinite for a model that explodes.
double simulation_loss(const IdData& data, const TransferStructure& structure, const VectorView& theta);

/// Fills fit, loss, noise variances and offsets (none) from structure and theta, for a simulation from rest. lssvf and
/// ivsvf leave it to whoever wants to know: it takes as long as they do. The fit of a model whose simulation grows
/// beyond all bounds is -infinity, and a warning says so.
void measure_simulation(Fit& fit, const IdData& data);

/// lssvf's theta with poles mirrored, for any structure: where an output's channels have denominators of their own, a
/// common one of their joint order is fitted first and each channel then to its share of that model's output. NaN when
/// the equations cannot be solved.
Vector lssvf_start(const IdData& data, const TransferStructure& structure, double lambda, Hold hold_y);

/// Which cut-off frequencies are followed: all, or those whose first estimate has a smaller loss than its neighbours'
/// and no more than three times the smallest loss found, which nearly always lead to the same in a third of the time:
/// enough for SRIVC's passes, behind which a search follows where they fail.
enum class CutoffTrials { kValleys, kAll };

/// A start that needs no guess: lssvf_start for cut-off frequencies over the band that the record can show, followed
/// by a few passes of iterate_srivc; the theta of smallest loss. Throws InvalidArgument when none is finite.
Vector best_cutoff_start(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                         CutoffTrials trials = CutoffTrials::kAll);

/// theta where a search begins: options.lambda's first estimate or the best of several cut-off frequencies.
Vector first_estimate(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                      CutoffTrials trials = CutoffTrials::kAll);

/// A start from rest for fixed delays: the first estimate at options.lambda or at the best of several cut-off
/// frequencies, on the beginning of a long record.
Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options,
                       CutoffTrials trials = CutoffTrials::kAll);

}  // namespace dynlab::inline numerics
