#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What the recursive methods ask.
struct RecursiveOptions {
    double lambda = 0;         ///< rad/s, cutoff frequency of the (first) filter; must be given
    Hold hold_y = Hold::kFoh;  ///< how the output behaves between its samples inside the filter
    double forgetting = 1;     ///< weight of a sample for each one that came later, in (0, 1]
    Vector drift;              ///< d variances of the parameters' random steps from sample to sample; none when empty
    std::optional<double> noise_variance;  ///< against which drift is weighed; default: from the errors so far
    std::optional<TransferFunction>
        model;                     ///< fixed, for instruments (rivsvf) and filters (rsrivc), in the estimate's place
    Index history_points = 2000;   ///< most instants that the history keeps
    std::function<bool()> cancel;  ///< asked every few thousand samples

    /// Throws InvalidArgument naming the option; d parameters.
    void validate(const std::string& method, Index parameters) const;
};

/// How messages call a method, and what it does: the beginning of a sentence.
struct RecursiveName {
    std::string name;
    Message title;
};

enum class RecursiveMethod { kLeastSquares, kInstruments, kRefined };

/// One pass over the data, at constant cost a sample, of the equation p^n y_f = phi' theta + e (CARX). kLeastSquares:
/// filters 1/(p + lambda)^n, z = phi. kInstruments: the same filters; z uses the output of a model, filtered like y.
/// kRefined: filters 1/A and the exact sensitivities z = [-p^(n-i) B/A^2 u, p^(m-l)/A u] of a model B/A. That model is
/// options.model throughout, or else the last suitable estimate, one sample late. An estimate is suitable if it was
/// stable and no faster than five times lambda; kRefined also requires a denominator known to 3 % (standard errors).
/// For the first samples (20/lambda seconds, and at least twenty samples for each parameter) the model is that of ivsvf
/// for these samples. Sums by InstrumentArray (fit/recursive/instrument_array.h): with forgetting 1 the last estimate
/// is the batch estimate to rounding. With `drift` the parameters follow a random walk between the samples (Kalman
/// filter). Filters are exact for the hold of u and y, for regular and irregular sampling (filters/evolving_filter.h).
/// Sets theta, covariance, noise_variance, history, message and the fields that describe_models sets. Throws
/// InvalidArgument for options, unsuitable data (check_transfer_data; several experiments, several channels, a delay
/// that is not a multiple of the sampling time, more than kMaxEvolvingPoles poles), and if all samples together do not
/// determine theta.
Fit recursive_pass(const RecursiveName& method, RecursiveMethod kind, const IdData& data,
                   const TransferStructure& structure, const RecursiveOptions& options);

}  // namespace dynlab::inline numerics
