#include <array>

#include "numerics/estimators/n4sid.h"
#include "scripting/arguments/option_words.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

Estimate estimate_of_subspace(const SubspaceFit& result) {
    Estimate estimate;
    estimate.method = "n4sid";
    estimate.message = in_lua_words(result.fit.message);
    estimate.warnings = result.fit.warnings;
    estimate.numbers = {{"fit_percent", result.fit.fit_percent[0]},
                        {"loss", result.fit.loss},
                        {"condition_number", result.fit.condition_number},
                        {"block_rows", result.block_rows}};
    estimate.vectors = {{"fits", result.fit.fit_percent}, {"singular_values", result.singular_values}};
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
    Model model{result.fit.models.front()};
    if (result.fit.models.size() > 1) model.channels = result.fit.models;
    model.outputs = static_cast<std::size_t>(data.output_count());
    model.estimate = std::make_shared<Estimate>(estimate_of_subspace(result));
    model.system = std::make_shared<StateSpace>(result.system);
    push_object(call.state(), std::move(model));
    return 1;
}

constexpr std::array kSubspaceFunctions = {
    FunctionEntry{"n4sid", "discrete time", "n4sid(data, order, {BlockRows =, Weighting =, Feedthrough =}) -> G",
                  "a state-space model by subspace identification, without iterating",
                  guarded<memoized_call<estimate_n4sid>>},
};

}  // namespace

FunctionEntries subspace_functions() {
    return kSubspaceFunctions;
}

}  // namespace dynlab::inline scripting
