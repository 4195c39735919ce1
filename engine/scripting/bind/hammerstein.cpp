#include <array>

#include "numerics/estimators/hammerstein.h"
#include "scripting/arguments/transfer_arguments.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

Estimate estimate_of(const HammersteinEstimate& result) {
    Estimate estimate = common_estimate("hammerstein", result);
    estimate.of_coefficients = false;
    estimate.numbers = {
        {"fit_percent", result.fit_percent},           {"linear_fit_percent", result.linear_fit_percent},
        {"noise_variance", result.noise_variance},     {"loss", result.loss},
        {"condition_number", result.condition_number}, {"iterations", static_cast<double>(result.iterations)}};
    estimate.vectors = {
        {"breakpoints", result.breakpoints}, {"levels", result.levels}, {"levels_std", result.levels_std}};
    return estimate;
}

int estimate_hammerstein(Call& call) {
    call.at_most(4);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(
        call, 4, {"Bins", "Breakpoints", "InitialState", "MaxIter", "Tol", "TdMin", "TdMax", "NumTd", "IODelay"});
    HammersteinOptions wanted;
    wanted.Bins = static_cast<int>(options.size("Bins", wanted.Bins));
    if (options.has("Breakpoints")) wanted.Breakpoints = options.vector("Breakpoints");
    wanted.initial_state = parse_initial_state(options.text("InitialState", "steady"));
    wanted.MaxIter = static_cast<int>(options.size("MaxIter", wanted.MaxIter));
    wanted.Tol = options.number("Tol", wanted.Tol);
    wanted.cancel = call.cancel();
    const TransferStructure structure = structure_of_counts(call, options, wanted)(data);
    const HammersteinEstimate result = hammerstein(data, structure, wanted);
    Model model{result.model};
    model.estimate = std::make_shared<Estimate>(estimate_of(result));
    push_object(call.state(), std::move(model));
    return 1;
}

constexpr std::array kHammersteinFunctions = {
    FunctionEntry{"hammerstein", "continuous time",
                  "hammerstein(data, np, nz, {Bins =, Breakpoints =, TdMin =, TdMax =, IODelay =, ...}) -> G",
                  "a static characteristic by bins, then linear dynamics",
                  guarded<memoized_call<estimate_hammerstein>>},
};

}  // namespace

FunctionEntries hammerstein_functions() {
    return kHammersteinFunctions;
}

}  // namespace dynlab::inline scripting
