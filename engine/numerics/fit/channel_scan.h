#pragma once
#include "numerics/fit/delay_scan.h"

namespace dynlab::inline numerics {

/// Whether a model has one output, several inputs with free delays, and a denominator for each of them.
bool has_separate_channels(const TransferStructure& structure);

/// Where a joint search begins for such a structure, from rest. Each channel in turn is searched as the only one is
/// (fit/transfer_search.h) on what the other channels leave of the output. It begins with the shares of a long
/// regression (fit/discrete/long_regression.h), for irregular sampling with a first estimate. After each the whole
/// model is refined. It ends after a round that gains nothing, and after three rounds. Of a longer record the first
/// 20,000 samples are looked at. The curve is that of the last channel.
DelayScan scan_channels(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
