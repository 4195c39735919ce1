#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "numerics/validation/order_selection.h"

namespace dynlab::inline numerics {

/// One structure A y = B u + e that was tried: na poles, nb coefficients of B, nk samples of delay.
struct ArxCandidate {
    int na = 1, nb = 1, nk = 1;
    double loss = 0;                        ///< mean square of the one-step prediction errors on the estimation data
    std::optional<double> validation_loss;  ///< the same on the validation data
    double aic = 0, bic = 0;                ///< of `loss` (validation/fit_measures.h); Ljung calls the BIC MDL
    bool determined = true;                 ///< the data determine the parameters

    int parameters() const { return na + nb; }
    /// On the validation data, if any.
    double comparison_loss() const { return validation_loss.value_or(loss); }
};

struct ArxSelection {
    std::vector<ArxCandidate> candidates;  ///< by na, then nb, then nk
    Index equations = 0;                   ///< of the estimation, the same for all
    bool validated = false;
};

/// Ranges from .. to.
struct ArxRanges {
    std::pair<int, int> na{1, 4}, nb{1, 4}, nk{1, 1};
};

/// Estimates every structure in the ranges by least squares on `data` (one input, one output, any number of
/// experiments, regular sampling), and predicts `validation` with it. All structures are compared over the same
/// samples: those for which the data contain the entire past that the largest structure needs. One pass over each data
/// set computes the triangular factor of the largest structure's equations; the others are columns of it. Throws
/// InvalidArgument for other data, empty or invalid ranges, and data that are too short. Reference: Ljung (1999),
/// section 16.4.
ArxSelection select_arx(const IdData& data, const ArxRanges& ranges, const IdData* validation = nullptr);

/// kLoss: on the validation data, if any.
enum class ArxCriterion { kLoss, kAic, kBic };
/// The value that is to be small.
double criterion_value(const ArxCandidate& candidate, ArxCriterion criterion);
/// The smallest value among the structures whose parameters are determined, among all where there is none. The
/// explanation says so, and what speaks against the choice.
OrderChoice choose_arx(const ArxSelection& selection, ArxCriterion criterion);
/// The default criterion for the orders: the loss on the validation data, or without them BIC.
ArxCriterion usual_criterion(const ArxSelection& selection);

}  // namespace dynlab::inline numerics
