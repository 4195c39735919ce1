#pragma once
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "numerics/fit/transfer_search.h"
#include "scripting/conversions/arguments.h"

namespace dynlab::inline scripting {

/// What the bindings of estimators have in common: orders, structures, options, estimations that are ready to be made.

/// An estimation as a script asked for it, its arguments checked: ready for any data, in any thread.
using Estimation = std::function<Fit(const IdData&)>;
/// The same with the options that it goes by.
struct OptionedEstimation {
    Estimation estimation;
    FitOptions options;
};

/// Reads the arguments of an estimator from the second one on. The first argument, the data, is not read.
using EstimationReader = Estimation (*)(const Call& call);

/// The readers of a file of bindings, by the methods' Lua names.
using NamedReader = std::pair<const char*, EstimationReader>;
using EstimationReaders = std::span<const NamedReader>;

// ---- Orders

/// One entry of an order vector and what it means in messages.
struct OrderEntry {
    const char* name;
    Message (*meaning)();
};

/// The orders {2, 1, 1} of a model, or {2, {1, 2}, {1, 1}} with several inputs: a list for each entry. Throws
/// InvalidArgument that says what the entries mean for another number of them, a value that is not whole, or a negative
/// one.
std::vector<std::vector<int>> order_lists(const Call& call, int index, std::span<const OrderEntry> entries);

/// What the entries mean: "{na, nb} (na: poles; nb: coefficients of B)".
Message meaning_of(std::span<const OrderEntry> entries);

// ---- Transfer functions in continuous time

inline constexpr OrderEntry kNa{"na", [] { return Message("poles"); }};
inline constexpr OrderEntry kNb{"nb", [] { return Message("coefficients of B"); }};
inline constexpr OrderEntry kNf{"nf", [] { return Message("poles"); }};
inline constexpr OrderEntry kNk{"nk", [] { return Message("samples of delay"); }};

/// Makes the structure for any data, in any thread, from arguments that were read and checked. Their lists have one
/// entry for all inputs or one for each, which hold for every output, or one for each channel. Throws InvalidArgument
/// where the data do not suit.
using StructureMaker = std::function<TransferStructure(const IdData&)>;
/// From the orders at argument 2. The entries hold kNb, kNk, and na or nf.
StructureMaker structure_of_orders(std::span<const OrderEntry> entries, const std::vector<std::vector<int>>& orders,
                                   Denominators sharing);
/// From np and nz at arguments 2 and 3; the delay is free unless IODelay or TdMax = TdMin (in `requested`) says
/// otherwise.
StructureMaker structure_of_counts(const Call& call, const Options& options, const FitOptions& requested);

/// A structure, and where the search for its parameters begins.
struct StartedStructure {
    StructureMaker structure;
    SearchAids aids;
};
/// From np and nz as above, with the delays of Td0, or from a start model at argument 2.
StartedStructure started_structure(const Call& call, const Options& options, const FitOptions& requested);

/// The option CommonDenominator.
Denominators sharing_of(const Options& options);
/// Reads those options of fits that the binding declares. Other members of `requested` keep their values.
void read_fit_options(const Options& options, FitOptions& requested);

/// A fit is the script's own model, or one of many in a study, whose data are simulated from rest.
enum class Purpose { kModel, kStudy };
FitOptions fit_options(const Options& options, Purpose purpose);
/// The EstimationReader of a function that reads for either purpose.
template <OptionedEstimation (*kRead)(const Call&, Purpose)>
Estimation read_for_study(const Call& call) {
    return kRead(call, Purpose::kStudy).estimation;
}

}  // namespace dynlab::inline scripting
