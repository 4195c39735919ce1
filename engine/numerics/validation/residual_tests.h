#pragma once
#include <vector>

#include "base/message.h"
#include "numerics/signals/iddata.h"
#include "numerics/statistics/whiteness.h"
#include "numerics/validation/compare.h"
#include "numerics/validation/model_assessment.h"

namespace dynlab::inline numerics {

struct Predictions;

/// Does the error of one output depend on one input?
struct IndependenceTest {
    Index input = 0;            ///< 0-based
    Vector correlation;         ///< lags -L..L, normalized; at positive ones the input acts before the error
    double bound = 0;           ///< lag by lag, for an error that the input does not touch
    double statistic = 0;       ///< of lags 0..L, chi-squared with `degrees` if independent, N large
    Index degrees = 0;          ///< fewer than L + 1 if the input is not rich enough to distinguish the lags
    Index outside = 0;          ///< lags 0..L beyond the bound
    double p_value = 1;         ///< lags 0..L: dynamics the model lacks
    double p_value_future = 1;  ///< lags -L..-1: feedback from the output to the input
    bool independent = true, without_feedback = true;
    bool tested = true;  ///< false for an input that never changes
    Message verdict;     ///< one sentence
};

struct OutputResiduals {
    double mean = 0, variance = 0;
    bool exact = false;  ///< nothing but rounding is left, so that nothing is tested
    WhitenessTest whiteness;
    std::vector<IndependenceTest> inputs;
    double fit_percent = 0;  ///< of the simulation
    Message verdict;         ///< what the tests say, and in the end the model_quality_message()
};

struct ResidualTests {
    std::vector<Matrix> residuals;  ///< per experiment, N x ny: measured minus simulated output
    std::vector<OutputResiduals> outputs;
    Message verdict;  ///< one paragraph per output
};

/// Tests on the output error e = y - simulated, all experiments together. Means are first subtracted from e and u in
/// each experiment. Whiteness: Ljung and Box (1978). Independence: under independence the cross-correlations r of lags
/// 0..L have the covariance P/N, P_ij = sum_k R_e(k) R_u(k + i - j) (Ljung 1999, section 16.6), reduced by the effect
/// of the ends of the data (see lagged_sum_covariance). The diagonal of P far from the ends gives the bound. The
/// statistic is N r' P^-1 r, N times the part R^2 of e that the input explains, and the p-value is that of R^2: exact
/// for white normal errors and data of any length. If e is not rejected as white, the sum has one term; otherwise it is
/// weighted (Bartlett) up to a quarter of the data. The degrees of freedom are not reduced by the estimated parameters,
/// so that the tests are slightly conservative. `simulated` contains N x ny outputs per experiment. Throws
/// InvalidArgument for sizes that do not match or fewer than two samples per lag.
ResidualTests residual_tests(const IdData& data, std::vector<Matrix> simulated, const ResidualOptions& options = {});

/// The same for a model, whose initial state and offset are handled as by compare_all(). The conclusion takes into
/// account the model's stability, its direct terms and delays, other starts, and the warnings of its estimation.
ResidualTests residual_tests(const IdData& data, const std::vector<TransferFunction>& channels,
                             const CompareOptions& simulation = {}, const ResidualOptions& options = {},
                             const ModelDoubts& doubts = {});

/// The same on the errors e of predictions one step ahead, which are white where the noise model is right.
ResidualTests prediction_error_tests(const IdData& data, const Predictions& predictions,
                                     const ResidualOptions& options = {});

}  // namespace dynlab::inline numerics
