#pragma once
#include "numerics/fit/recursive/recursive_pass.h"

namespace dynlab::inline numerics {

/// srivc in one pass, sample by sample, for y = B/F u(t - delay) + e: filters 1/F and instruments follow the last
/// stable estimate with a delay of one sample; so noise does not bias it, and white noise is met best. With
/// options.model the filters stay, and with forgetting 1 and no drift the end is one pass of srivc from that model:
/// srivc's own theta is where such a pass stays. Sizes, options and what is thrown: fit/recursive/recursive_pass.h.
/// Reference: Young (2011), chapters 6 and 7.
/// The first stretch must excite the system: samples that went through filters of a poor first model stay in mind
/// until they are forgotten.
Fit rsrivc(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options);

}  // namespace dynlab::inline numerics
