#pragma once
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

/// The estimate of SRIVC's passes; or the end of a search of the output error over all parameters (search_transfer), if it lies lower, where they may have ended in a bad
/// minimum: they did not settle, explain little, leave errors that follow the input, or gain nothing over a model with
/// fewer poles or zeros.
Fit search_where_passes_fail(Fit estimate, const IdData& data, const FitOptions& options, const SearchAids& aids);

}  // namespace dynlab::inline numerics
