#pragma once
#include <span>
#include <vector>

#include "numerics/fit/transfer_search.h"
#include "scripting/arguments/estimation.h"
#include "scripting/arguments/order_vector.h"

namespace dynlab::inline scripting {

/// What the bindings of continuous-time estimators have in common.

inline constexpr OrderEntry kNa{"na", "poles"};
inline constexpr OrderEntry kNb{"nb", "coefficients of B"};
inline constexpr OrderEntry kNf{"nf", "poles"};
inline constexpr OrderEntry kNk{"nk", "samples of delay"};

/// Makes the structure for any data, in any thread, from arguments that were read and checked. Their lists have one
/// entry for all inputs or one for each, which hold for every output, or one for each channel. Throws InvalidArgument
/// where the data do not suit.
using StructureMaker = std::function<TransferStructure(const IdData&)>;
/// From the orders at argument 2. The entries hold kNb, kNk, and na or nf.
StructureMaker structure_of_orders(std::span<const OrderEntry> entries, const std::vector<std::vector<int>>& orders,
                                   Denominators sharing);
/// From np and nz at arguments 2 and 3; the delay is free unless IODelay or TdMax = TdMin (in `wanted`) says otherwise.
StructureMaker structure_of_counts(const Call& call, const Options& options, const FitOptions& wanted);

/// A structure, and where the search for its parameters begins.
struct StartedStructure {
    StructureMaker structure;
    SearchAids aids;
};
/// From np and nz as above, with the delays of Td0, or from a start model at argument 2.
StartedStructure started_structure(const Call& call, const Options& options, const FitOptions& wanted);

/// The option CommonDenominator.
Denominators sharing_of(const Options& options);
Hold hold_y_of(const Options& options);
/// The options of fits, those of them that the binding knows; for others `wanted` keeps what it holds.
void read_fit_options(const Options& options, FitOptions& wanted);

/// A fit is the script's own model, or one of many in a study, which asks for no doubts.
enum class Purpose { kModel, kStudy };
FitOptions fit_options(const Options& options, Purpose purpose);
/// The EstimationReader of a function that reads for either purpose.
template <Estimation (*kRead)(const Call&, Purpose)>
Estimation read_for_study(const Call& call) {
    return kRead(call, Purpose::kStudy);
}

}  // namespace dynlab::inline scripting
