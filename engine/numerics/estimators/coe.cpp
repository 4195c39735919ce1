#include "numerics/estimators/coe.h"

#include "numerics/fit/transfer_search.h"

namespace dynlab::inline numerics {

Fit coe(const IdData& data, const TransferStructure& structure, const FitOptions& options, const SearchAids& aids) {
    options.validate();
    return search_transfer("coe", data, structure, options, aids);
}

}  // namespace dynlab::inline numerics
