#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Grid of delays (s), and the smallest mean square simulation error found at each: what a delay is first looked for
/// on.
struct DelayScan {
    Vector delays, losses;
    std::vector<Vector> starts;  ///< theta with the delay, of the lowest valleys of the curve, best first
};

/// The largest delay worth looking at: where the correlation of the input with later output has its peak, and a bit
/// more; at least a few samples, at most a quarter of the shortest record.
double likely_largest_delay(const IdData& data);

/// Loss over the delay of every channel in turn (the others as found so far), from least_delay to largest_delay of the
/// options in at most delay_count steps of at least one mean sampling time. At each delay a few passes of srivc run
/// from filtered starts and from the neighbour's result. The curve is the last channel's.
DelayScan scan_delays(const IdData& data, const TransferStructure& structure, const FitOptions& options);

/// Output-error estimate under all options: offsets and operating points, start conditions tried where they are
/// "auto" (smallest BIC), delays looked for on a grid when the structure has them free; the best starts are refined
/// jointly (transfer_refinement.h). `method` begins messages of errors. `start`: where the search for fixed delays
/// begins, when it is given.
Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure,
                    const FitOptions& options, const Vector& start = {});

/// A start from rest for fixed delays: the first estimate at options.lambda or at the best of several cut-off
/// frequencies, on the beginning of a long record.
Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
