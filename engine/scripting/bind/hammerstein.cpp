#include "numerics/estimators/hammerstein.h"

#include <array>

#include "base/catalog.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kRestStates = {"none", "steady", "auto"};  // of InitialState
constexpr std::array kCharacteristicOptions = {
    option<&HammersteinOptions::bins>("Bins",
                                      about("number of equally spaced bins between the smallest and the largest input"),
                                      {.minimum = 1, .maximum = 1000, .member = "bins"}),
    option<&HammersteinOptions::breakpoints>(
        "Breakpoints", about("bin edges, such as the ends of a dead band, instead of equally spaced bins"),
        {.member = "breakpoints"}),
    option<&HammersteinOptions::initial_state>(
        "InitialState",
        about("initial state: at rest with the first input value (\"steady\") or with zero input (\"none\"), or the "
              "better of these two (\"auto\")"),
        {.initial = "\"auto\"", .choices = kRestStates, .former = "zero", .member = "initial_state"})};
/// Read by structure_of_counts(), as kKnownDelayOption, but for one channel.
constexpr std::array kKnownDelayOfOneChannel = {OptionEntry{
    "IODelay", ValueKind::kNumber, about("known delay, which is not estimated"), {.unit = "s", .member = "delay"}}};
constexpr OptionTable kHammerstein[] = {kCharacteristicOptions, kDelayOptions, kKnownDelayOfOneChannel, kLimitOptions};

constexpr std::array kHammersteinArguments = {
    ArgumentEntry{"data", ValueKind::kData,
                  about("data object with one input (zero-order hold), one output and any number of experiments")},
    ArgumentEntry{"np", ValueKind::kCount, about("number of poles of the linear part")},
    ArgumentEntry{"nz", ValueKind::kCount, about("number of zeros of the linear part")}};

int estimate_hammerstein(Call& call) {
    call.at_most(4);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 4, kHammerstein);
    HammersteinOptions requested;
    read_fit_options(options, requested);
    options.read(requested);
    const TransferStructure structure = structure_of_counts(call, options, requested)(data);
    return give_fit(call, "hammerstein", hammerstein(data, structure, requested));
}

constexpr FunctionEntry kHammersteinFunctions[] = {
    {"hammerstein", "continuous time", "hammerstein(data, np, nz, {options}) -> G",
     marked("estimator", "Estimate a static characteristic followed by linear dynamics"),
     guarded<memoized_call<estimate_hammerstein>>, kHammerstein, kHammersteinArguments},
};

}  // namespace

FunctionEntries hammerstein_functions() {
    return kHammersteinFunctions;
}

}  // namespace dynlab::inline scripting
