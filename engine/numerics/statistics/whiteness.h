#pragma once
#include <vector>

#include "base/message.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Of tests on the errors of a model.
struct ResidualOptions {
    Index lags = 25;
    double confidence = 0.99;  ///< of the bounds; a test rejects below 1 - confidence

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// Is the output error of one output predictable from its own past?
struct WhitenessTest {
    Vector correlation;              ///< lags 0..L, normalized: the first is 1
    double bound = 0;                ///< a white error stays within +-bound with the wanted confidence, lag by lag
    double statistic = 0;            ///< Ljung-Box, chi-squared with `degrees` if white
    Index degrees = 0, outside = 0;  ///< outside: lags 1..L beyond the bound
    double p_value = 1;
    bool white = true;
    Message verdict;  ///< one sentence; empty for an error that is constant
};

/// The test of Ljung and Box (1978), of one output's errors in one or several uninterrupted experiments, whose means
/// are subtracted first. For data too short for the lags fewer lags are tested. Throws InvalidArgument for invalid
/// options.
WhitenessTest whiteness_test(const std::vector<Vector>& errors, const ResidualOptions& options = {});

enum class ModelError { kOutput, kPrediction };

/// The same test of errors `e` without mean whose covariances R of lags 0..L are known; the text of its result names
/// their kind.
WhitenessTest whiteness_of_covariances(const std::vector<Vector>& e, const VectorView& R, double confidence,
                                       ModelError kind);

/// "p = 0.034" or "p < 0.001".
Message probability_text(double p);

}  // namespace dynlab::inline numerics
