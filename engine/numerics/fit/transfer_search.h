#pragma once
#include <vector>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

/// What is known before a search.
struct SearchAids {
    /// theta where the search begins, with the delays where they are free; default: computed.
    Vector start = {};
    std::vector<double> delays = {};  ///< s, of each channel: where the search for free ones begins
    std::vector<const Fit*> lower_order =
        {};  ///< of poorer structures under the same options; they are not fitted again
};

/// Output-error estimate under all options: offsets and operating points, start conditions tried where they are
/// "auto" (smallest BIC), delays looked for on a grid when the structure has them free (delay_scan.h); the best
/// starts are refined jointly (transfer_refinement.h). The solution of a single output of up to 100,000
/// samples is no worse than those that the same search finds for poorer structures (search_starts.h) and, where an
/// initial state is estimated, for the zero state. Where errors of one input and one output follow the input or
/// themselves, the search is repeated with poles exchanged (search_starts.h) and, where they are fast and sampling is
/// regular, from the poles of difference equations (sampled_starts.h). Where the options do not say, an unstable model
/// is given only if it lowers the loss by 2 % and more. `method` begins messages of errors. Throws InvalidArgument as
/// fit_output_error(), and for fixed parameters or weights that do not suit the structure.
Fit search_transfer(const char* method, const IdData& data, const TransferStructure& structure,
                    const FitOptions& options, const SearchAids& aids = {});
/// The same; start conditions that the options leave open are tried only where a fit from rest gives reason to
/// (fit/start_choice.h), or where the search begins at a given theta.
Fit search_with_chosen_start(const char* method, const IdData& data, const TransferStructure& structure,
                             const FitOptions& options, const SearchAids& aids = {});

}  // namespace dynlab::inline numerics
