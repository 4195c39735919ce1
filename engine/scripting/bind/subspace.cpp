#include <array>

#include "base/catalog.h"
#include "numerics/estimators/n4sid.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/option_member.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kWeightings = {"MOESP", "N4SID", "CVA"};  // in the order of SubspaceWeighting
constexpr std::array kSubspaceOptions = {
    option<&SubspaceOptions::block_rows>("BlockRows",
                                         about("number of past and of future samples, greater than the order; 0 for a "
                                               "number based on the order and the length of the data"),
                                         {.member = "block_rows"}),
    option<&SubspaceOptions::weighting>("Weighting", about("weighting matrices of the singular value decomposition"),
                                        {.initial = "\"MOESP\"", .choices = kWeightings}),
    option<&SubspaceOptions::feedthrough>("Feedthrough",
                                          about("true estimates the direct feedthrough D; otherwise, D is zero"))};
constexpr OptionTable kSubspace[] = {kSubspaceOptions};

constexpr std::array kSubspaceArguments = {
    ArgumentEntry{
        "data", ValueKind::kData,
        about("regularly sampled data object with at least one input and any number of outputs and experiments")},
    ArgumentEntry{"order", ValueKind::kCount, about("number of states")}};

Estimate estimate_of_subspace(const SubspaceFit& result) {
    Estimate estimate = basic_estimate("n4sid", result.fit);
    estimate.fields.edit().numbers.emplace_back("block_rows", result.block_rows);
    estimate.fields.edit().vectors.emplace_back("singular_values", result.singular_values);
    estimate.fields.edit().matrices = {{"initial_states", result.initial_states}};
    return estimate;
}

int estimate_n4sid(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Index order = call.size(2, "order");
    const Options options(call, 3, kSubspace);
    SubspaceOptions requested;
    options.read(requested);
    const SubspaceFit result = n4sid(data, static_cast<int>(order), requested);
    return give_system(call, estimate_of_subspace(result), result.fit, result.system);
}

constexpr FunctionEntry kSubspaceFunctions[] = {
    {"n4sid", "discrete time", "n4sid(data, order, {options}) -> G",
     marked("estimator", "Estimate a state-space model by subspace identification"),
     guarded<memoized_call<estimate_n4sid>>, kSubspace, kSubspaceArguments},
};

}  // namespace

FunctionEntries subspace_functions() {
    return kSubspaceFunctions;
}

}  // namespace dynlab::inline scripting
