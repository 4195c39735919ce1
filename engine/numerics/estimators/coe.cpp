#include "numerics/estimators/coe.h"

#include "numerics/fit/finished_fit.h"
#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

Fit coe(const IdData& data, const TransferStructure& structure, const FitOptions& options, const SearchAids& aids) {
    options.validate();
    return finished_fit(data, options, [&](const IdData& seen, const FitOptions& requested) {
        return search_with_chosen_start("coe", seen, structure, requested, aids);
    });
}

}  // namespace dynlab::inline numerics
