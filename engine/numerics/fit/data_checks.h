#pragma once
#include <string>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What estimators refuse. `method` begins the messages of the InvalidArgument they throw.

/// Data without inputs, with an input that is zero throughout, or with an output that never changes.
void check_signals(const std::string& method, const IdData& data);

/// The same; data of other channels than the structure, with fewer than 3 samples per parameter, not longer than a
/// fixed delay, or with a constant input although the output does not start from rest, so that it is no step.
void check_transfer_data(const std::string& method, const IdData& data, const TransferStructure& structure);

/// Those of check_signals, and data that are not regularly sampled.
void check_sampled_data(const std::string& method, const IdData& data);

/// The same for one output and as many inputs as the orders have, with delays shorter than each record.
void check_polynomial_data(const std::string& method, const IdData& data, const PolynomialOrders& orders);

/// No more samples than `values` to estimate.
void check_sample_count(const std::string& method, Index samples, Index values);

/// For data whose inputs never change: a fit of so many estimated values that explains no transient (see
/// require_transient in criteria/initial_conditions.h). A cancelled fit passes.
void check_transient(const std::string& method, const IdData& data, const Fit& fit, Index values);

double shortest_record(const IdData& data);  ///< s, of all experiments

struct DelayRange {
    double least = 0, largest = 0;  ///< s
};
/// Between which a free delay is looked for: least_delay and largest_delay; without the latter a quarter of the
/// shortest record. Throws InvalidArgument for a largest delay that is not shorter than the shortest record.
DelayRange delay_range(const IdData& data, const FitOptions& options);

}  // namespace dynlab::inline numerics
