#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "numerics/fit/transfer_estimate.h"
#include "scripting/arguments/arguments.h"
#include "scripting/arguments/order_vector.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {

/// What the bindings of continuous-time estimators have in common.

inline constexpr OrderEntry kNa{"na", "poles"};
inline constexpr OrderEntry kNb{"nb", "coefficients of B"};
inline constexpr OrderEntry kNf{"nf", "poles"};
inline constexpr OrderEntry kNk{"nk", "samples of delay"};

/// Makes the structure for any data, in any thread, from arguments that were read and checked. Their lists have one
/// entry for all inputs or one for each, and hold for every output. Throws InvalidArgument where the data do not suit.
using StructureMaker = std::function<TransferStructure(const IdData&)>;
/// From the orders at argument 2. The entries hold kNb, kNk, and na or nf.
StructureMaker structure_of_orders(std::span<const OrderEntry> entries, const std::vector<std::vector<int>>& orders,
                                   Denominators sharing);
/// From np and nz at arguments 2 and 3 and the options of delays, which are written into `wanted` too: the delay is
/// free unless IODelay or TdMax = TdMin says otherwise.
StructureMaker structure_of_counts(const Call& call, const Options& options, TransferOptions& wanted);

/// The option CommonDenominator.
Denominators sharing_of(const Options& options);
Hold hold_y_of(const Options& options);
/// The options that srivc, coe, rivc and their tf twins share.
void read_common_options(const Options& options, TransferOptions& wanted);

/// What a script can ask of the result.
Estimate estimate_of(const char* method, const TransferEstimate& result);
/// The model with all its channels.
int give_estimate(const Call& call, Estimate estimate, const TransferEstimate& result);

}  // namespace dynlab::inline scripting
