#include "numerics/estimators/recursive/rivsvf.h"

namespace dynlab::inline numerics {

Fit rivsvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options) {
    return recursive_pass({"rivsvf", Message("Instrumental variables on filtered signals")},
                          RecursiveMethod::kInstruments, data, structure, options);
}

}  // namespace dynlab::inline numerics
