
#include "numerics/estimators/hammerstein.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

int estimate_hammerstein(Call& call) {
    call.at_most(4);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(
        call, 4, {"Bins", "Breakpoints", "InitialState", "MaxIter", "Tol", "TdMin", "TdMax", "NumTd", "IODelay"});
    HammersteinOptions wanted;
    read_fit_options(options, wanted);
    wanted.bins = static_cast<int>(options.size("Bins", wanted.bins));
    if (options.has("Breakpoints")) wanted.breakpoints = options.vector("Breakpoints");
    const TransferStructure structure = structure_of_counts(call, options, wanted)(data);
    return give_fit(call, "hammerstein", hammerstein(data, structure, wanted));
}

constexpr FunctionEntry kHammersteinFunctions[] = {
    {"hammerstein", "continuous time",
     "hammerstein(data, np, nz, {Bins =, Breakpoints =, TdMin =, TdMax =, IODelay =, ...}) -> G",
     "a static characteristic by bins, then linear dynamics", guarded<memoized_call<estimate_hammerstein>>},
};

}  // namespace

FunctionEntries hammerstein_functions() {
    return kHammersteinFunctions;
}

}  // namespace dynlab::inline scripting
