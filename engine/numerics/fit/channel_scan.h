#pragma once
#include "numerics/fit/delay_scan.h"

namespace dynlab::inline numerics {

/// Whether a model has one output, several inputs with free delays, and a denominator for each of them.
bool has_separate_channels(const TransferStructure& structure);

/// Finds the start of a joint search for such a structure, from rest. Each channel in turn is searched like a single
/// channel (fit/transfer_search.h) on the part of the output that the other channels do not explain. The first shares
/// come from a long regression (fit/discrete/long_regression.h), for irregular sampling from a first estimate. After
/// each channel the complete model is refined. The scan ends after a round without improvement, and after three rounds.
/// It uses at most the first 20,000 samples. The returned curve is that of the last channel.
DelayScan scan_channels(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
