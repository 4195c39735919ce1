#include "numerics/estimators/recursive/rlssvf.h"

namespace dynlab::inline numerics {

Fit rlssvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options) {
    return recursive_pass({"rlssvf", Message("Least squares on filtered signals")}, RecursiveMethod::kLeastSquares,
                          data, structure, options);
}

}  // namespace dynlab::inline numerics
