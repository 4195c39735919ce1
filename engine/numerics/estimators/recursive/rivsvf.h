#pragma once
#include "numerics/fit/recursive/recursive_pass.h"

namespace dynlab::inline numerics {

/// ivsvf in one pass, sample by sample. The instruments of rivsvf use the output of a model instead of y, so that noise
/// does not bias the estimate; otherwise rivsvf is like rlssvf. The model is the last stable estimate, or
/// options.model. If options.model is that of lssvf, with forgetting 1 and no drift, the last theta is that of ivsvf to
/// rounding. Sizes, options and errors: fit/recursive/recursive_pass.h. Reference: Young (2011), chapters 6 and 7.
Fit rivsvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options);

}  // namespace dynlab::inline numerics
