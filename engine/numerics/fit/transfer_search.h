#pragma once
#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// Output-error estimate under all options: offsets and operating points, start conditions tried where they are
/// "auto" (smallest BIC), delays looked for on a grid when the structure has them free (search_starts.h); the best
/// starts are refined jointly (transfer_refinement.h). The solution of a single output of up to 100,000
/// samples is no worse than those that the same search finds for poorer structures (search_starts.h) and, where an
/// initial state is estimated, for the zero state. `method` begins messages of errors. `start`: where the search for
/// fixed delays begins, when it is given.
Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure,
                    const FitOptions& options, const Vector& start = {});

/// A start from rest for fixed delays: the first estimate at options.lambda or at the best of several cut-off
/// frequencies, on the beginning of a long record.
Vector start_from_rest(const IdData& data, const TransferStructure& structure, const FitOptions& options);

}  // namespace dynlab::inline numerics
