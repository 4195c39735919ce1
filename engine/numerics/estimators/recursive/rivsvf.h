#pragma once
#include "numerics/fit/recursive/recursive_pass.h"

namespace dynlab::inline numerics {

/// ivsvf in one pass, sample by sample: as rlssvf, but with the output of a model in the place of y in the instruments,
/// so that noise does not bias it. The model is the last stable estimate, or options.model; with the latter, forgetting
/// 1 and no drift, the end is ivsvf's theta to rounding where the model is that of lssvf. Sizes, options and what is
/// thrown: fit/recursive/recursive_pass.h. Reference: Young (2011), chapters 6 and 7.
Fit rivsvf(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options);

}  // namespace dynlab::inline numerics
