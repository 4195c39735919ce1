#pragma once
#include <optional>
#include <vector>

#include "numerics/criteria/denominator_group.h"
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

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
/// with signals filtered by 1/A of the previous pass, and z the exact sensitivities of the simulated output; unstable
/// poles are mirrored. If channels of one output have different denominators, each group explains the part of the
/// output that the others leave (back-fitting). The iteration converges when no parameter changes by more than
/// tolerance relative to its value, checked before poles are mirrored. It also converges when all remaining changes are
/// below that limit: they shrink by a nearly constant factor, estimated from the last two, but at least 1/20. A pass
/// with little progress over the previous one that raises the loss is shortened. Without convergence the result is the
/// pass of smallest loss.
SrivcSolution iterate_srivc(const IdData& data, const TransferStructure& structure, const Vector& start,
                            const FitOptions& options, const SrivcExtras& extras = {});

/// The loss of a solution, which is not simulated again where it is known.
double simulation_loss(const IdData& data, const TransferStructure& structure, const SrivcSolution& solution);
}  // namespace dynlab::inline numerics
