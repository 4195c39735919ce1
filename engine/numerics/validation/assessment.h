#pragma once
#include <string>
#include <vector>

#include "numerics/estimators/procsrivc.h"
#include "numerics/fit/polynomial_estimate.h"
#include "numerics/fit/transfer_estimate.h"
#include "numerics/signals/iddata.h"
#include "numerics/validation/residual_tests.h"

namespace dynlab::inline numerics {

/// Whether the plain standard errors of an output-error estimate, which take its errors as white, can be trusted, and
/// those to use when they cannot.
struct Assessment {
    std::vector<WhitenessTest> whiteness;  ///< one per output
    bool white = true;                     ///< all of them
    Matrix covariance;                     ///< robust, in the order of the estimate's theta
    Vector std;
    Index bandwidth = 1;  ///< samples, of its window
    std::string verdict;  ///< one sentence per output
};

/// Sensitivities and output errors are worked out again at the estimate, from its start condition and with the values
/// that enter linearly (initial state, offset) projected out, then handed to robust_covariance() and
/// whiteness_test(). Each output counts with one over the standard deviation of its errors, as in the fit of outputs
/// that share a denominator. Errors of different experiments count as independent of each other, those of different
/// outputs need not be. Parameters whose plain variance is zero (held at a bound) keep it. `data` are those the
/// estimator saw, with any operating point already removed. Throws InvalidArgument for data that do not fit the
/// estimate's channels.
Assessment assess(const IdData& data, const TransferEstimate& estimate, const ResidualOptions& options = {});
/// The same for a process model; the operating point the result names is removed here.
Assessment assess(const IdData& data, const ProcsrivcResult& estimate, const ResidualOptions& options = {});
/// The same for models of difference equations (not of iv4, whose instruments it does not know), with the `offset` they
/// were asked for, so that operating points are removed here: of their prediction errors, which for oe and sriv are the
/// simulation errors. Throws InvalidArgument where the model's output grows beyond all bounds.
Assessment assess(const IdData& data, const PolynomialEstimate& estimate, Offset offset,
                  const ResidualOptions& options = {});

}  // namespace dynlab::inline numerics
