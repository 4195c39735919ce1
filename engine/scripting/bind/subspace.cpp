
#include "numerics/estimators/n4sid.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

Estimate estimate_of_subspace(const SubspaceFit& result) {
    Estimate estimate = basic_estimate("n4sid", result.fit);
    estimate.numbers.emplace_back("block_rows", result.block_rows);
    estimate.vectors.emplace_back("singular_values", result.singular_values);
    estimate.matrices = {{"initial_states", result.initial_states}};
    return estimate;
}

int estimate_n4sid(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Index order = call.size(2, "order");
    const Options options(call, 3, {"BlockRows", "Weighting", "Feedthrough"});
    SubspaceOptions wanted;
    wanted.block_rows = static_cast<int>(options.size("BlockRows", wanted.block_rows));
    wanted.weighting = parse_subspace_weighting(options.text("Weighting", "MOESP"));
    wanted.feedthrough = options.flag("Feedthrough", wanted.feedthrough);
    const SubspaceFit result = n4sid(data, static_cast<int>(order), wanted);
    return give_system(call, estimate_of_subspace(result), result.fit, result.system);
}

constexpr FunctionEntry kSubspaceFunctions[] = {
    {"n4sid", "discrete time", "n4sid(data, order, {BlockRows =, Weighting =, Feedthrough =}) -> G",
     "a state-space model by subspace identification, without iterating", guarded<memoized_call<estimate_n4sid>>},
};

}  // namespace

FunctionEntries subspace_functions() {
    return kSubspaceFunctions;
}

}  // namespace dynlab::inline scripting
