#include <array>

#include "base/catalog.h"
#include "numerics/estimators/rivc.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/estimation_readers.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OrderEntry kNc{"nc", [] { return Message("coefficients of C without the leading 1"); }};
constexpr OrderEntry kNd{"nd", [] { return Message("coefficients of D without the leading 1"); }};
constexpr std::array kNoiseModelOrders = {kNb, kNc, kNd, kNf, kNk};

constexpr std::array kNoiseSearchOptions = {kStableOption, kFixedOption};
constexpr std::array kNoiseOrderOptions = {
    option<&NoiseOrders::nc>("nc", about("number of coefficients of C without the leading 1")),
    option<&NoiseOrders::nd>("nd", about("number of coefficients of D without the leading 1"), {.initial = "1"})};
constexpr OptionTable kNoisy[] = {kFirstFilterOptions, kStartOptions,   kLimitOptions,
                                  kIntegrationOptions, kSharingOptions, kNoiseSearchOptions};
constexpr OptionTable kNoisyTransferFunction[] = {kNoiseOrderOptions,  kDelayOptions,   kFixedDelayOptions,
                                                  kFirstFilterOptions, kStartOptions,   kLimitOptions,
                                                  kIntegrationOptions, kSharingOptions, kNoiseSearchOptions};

constexpr std::array kNoisyArguments = {
    kOneOutputData,
    ArgumentEntry{
        "orders", ValueKind::kOrders,
        about("nb coefficients of B (at most nf + 1), nc, nd and nf coefficients of C, D and F without the leading 1, "
              "and an input delay of nk samples. With several inputs, nb, nf and nk are tables")}};
constexpr std::array kNoisyTransferArguments = {
    kOneOutputData,
    ArgumentEntry{"np", ValueKind::kCount,
                  about("number of poles; with several inputs, one number for all or a table with one per input")},
    ArgumentEntry{"nz", ValueKind::kCount,
                  about("number of zeros; with several inputs, one number for all or a table with one per input")}};

int noise_order(const std::vector<int>& entry, const OrderEntry& what) {
    if (entry.size() == 1) return entry.front();
    throw InvalidArgument("{} must be one number for the noise of the output, but {} values were given", what.name,
                          entry.size());
}

OptionedEstimation noisy_estimation(const StructureMaker& structure, const NoiseOrders& noise,
                                    const FitOptions& requested) {
    return {[=](const IdData& data) { return rivc(data, structure(data), noise, requested); }, requested};
}

OptionedEstimation read_rivc(const Call& call, Purpose purpose) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kNoiseModelOrders);
    const Options options(call, 3, kNoisy);
    return noisy_estimation(structure_of_orders(kNoiseModelOrders, orders, sharing_of(options)),
                            {noise_order(orders[1], kNc), noise_order(orders[2], kNd)}, fit_options(options, purpose));
}

OptionedEstimation read_tfrivc(const Call& call, Purpose purpose) {
    call.at_most(4);
    const Options options(call, 4, kNoisyTransferFunction);
    const FitOptions requested = fit_options(options, purpose);
    const StructureMaker structure = structure_of_counts(call, options, requested);
    NoiseOrders noise{0, 1};
    options.read(noise);
    return noisy_estimation(structure, noise, requested);
}

template <auto kRead>
int estimate_with_noise(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const OptionedEstimation requested = kRead(call, Purpose::kModel);
    return give_diagnosed_fit(call, call.function_name(), requested.estimation(data), requested.options);
}

constexpr NamedReader kNoiseModelsReaders[] = {{"rivc", read_for_study<read_rivc>},
                                               {"tfrivc", read_for_study<read_tfrivc>}};

constexpr FunctionEntry kNoiseModelsFunctions[] = {
    {"rivc", "continuous time", "rivc(data, {nb, nc, nd, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + C/D e with a noise model"),
     guarded<memoized_call<estimate_with_noise<read_rivc>>>, kNoisy, kNoisyArguments},
    {"tfrivc", "continuous time", "tfrivc(data, np, nz, {options}) -> G",
     marked("estimator", "Estimate a transfer function with delay and a noise model"),
     guarded<memoized_call<estimate_with_noise<read_tfrivc>>>, kNoisyTransferFunction, kNoisyTransferArguments},
};

}  // namespace

EstimationReaders noise_model_readers() {
    return kNoiseModelsReaders;
}

FunctionEntries noise_model_functions() {
    return kNoiseModelsFunctions;
}

}  // namespace dynlab::inline scripting
