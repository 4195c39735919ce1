#include "numerics/estimators/coe.h"

#include "numerics/kernels/transfer_search.h"

namespace dynlab {

TransferEstimate coe(const IdData& data, const TransferStructure& structure, const TransferOptions& options) {
    options.validate();
    return search_transfer("coe", data, structure, options);
}

}  // namespace dynlab
