#pragma once
#include <utility>
#include <vector>

#include "numerics/criteria/initial_conditions.h"
#include "numerics/fit/termination.h"

namespace dynlab::inline numerics {

/// A fit under one start condition; Result has a `termination`.
template <class Result>
struct Candidate {
    Result result;
    double bic = 0;
};

/// What "auto" means: the fit of smallest BIC among the start conditions (one at least). `fit_one(condition)` gives a
/// Candidate; conditions for which `enough(condition)` does not see enough samples are left out, but for the first. A
/// cancelled fit ends the choice.
template <class Enough, class FitOne>
auto smallest_bic(const std::vector<StartCondition>& conditions, const Enough& enough, const FitOne& fit_one) {
    auto best = fit_one(conditions.front());
    for (std::size_t i = 1; i < conditions.size() && best.result.termination != Termination::kCancelled; ++i) {
        if (!enough(conditions[i])) continue;
        auto candidate = fit_one(conditions[i]);
        if (candidate.bic < best.bic) best = std::move(candidate);
    }
    return std::move(best.result);
}

}  // namespace dynlab::inline numerics
