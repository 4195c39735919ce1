#pragma once
#include <string>

#include "numerics/fit/transfer_data.h"
#include "numerics/fit/transfer_estimate.h"

namespace dynlab::inline numerics {

/// Writes the standard errors, warnings and message of an output-error estimate whose other fields are filled: what
/// ended the search (`method` begins the sentence), what was simulated, the fit; then doubts: no convergence, those of
/// report_errors, an unstable model, free delays at an edge of `range`, or known only to within one
/// sampling time of `data`. Warnings that are already there stay in front.
void describe_refinement(TransferEstimate& estimate, const IdData& data, const std::string& method,
                         const TransferOptions& options, const DelayRange& range);

}  // namespace dynlab::inline numerics
