#pragma once
#include <optional>
#include <string>
#include <vector>

#include "numerics/fit/fit.h"
#include "numerics/signals/iddata.h"
#include "numerics/statistics/whiteness.h"

namespace dynlab::inline numerics {

/// Whether the plain standard errors of an output-error estimate, which take its errors as white, can be trusted, and
/// those to use when they cannot.
struct Assessment {
    std::vector<WhitenessTest> whiteness;  ///< one per output
    bool white = true;                     ///< all of them
    Matrix covariance;                     ///< robust, in the order of the estimate's theta
    Vector std;
    Index bandwidth = 1;  ///< samples, of its window
    /// One sentence per output, and which standard errors to use; none for an unstable model or one that explains
    /// little.
    Message verdict;
};

/// Sensitivities and output errors are worked out again at the estimate, from its start condition and with the values
/// that enter linearly (initial state, offset) projected out, then handed to robust_covariance() and
/// whiteness_test(). Each output counts with one over the standard deviation of its errors, as in the fit of outputs
/// that share a denominator. Errors of different experiments count as independent of each other, those of different
/// outputs need not be. Parameters whose plain variance is zero (held at a bound) keep it. Models of difference
/// equations (not of iv4, whose instruments it does not know) are assessed by their prediction errors, which for oe and
/// sriv are the simulation errors. `data` are those the estimator was given; the operating points that the fit names
/// are removed here. Throws InvalidArgument for data that do not fit the estimate's channels, and where a model's
/// output grows beyond all bounds.
Assessment assess(const IdData& data, const Fit& fit, const ResidualOptions& options = {});

/// Samples: robust errors of longer data would take longer than the fit, except for process models.
inline constexpr Index kMaxAssessedSamples = 200'000;
/// Assesses a fit if the assessment is cheap compared with the fit, and meaningful. Returns no value for longer data,
/// canceled fits, fits without a covariance, difference equations without finite standard errors, and models with
/// unbounded output.
std::optional<Assessment> assess_if_affordable(const IdData& data, const Fit& fit);

}  // namespace dynlab::inline numerics
