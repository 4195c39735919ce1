#include "numerics/estimators/recursive/rsrivc.h"

namespace dynlab::inline numerics {

Fit rsrivc(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options) {
    return recursive_pass({"rsrivc", Message("Refined instrumental variables")}, RecursiveMethod::kRefined, data,
                          structure, options);
}

}  // namespace dynlab::inline numerics
