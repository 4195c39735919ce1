#include <array>

#include "numerics/estimators/rivc.h"
#include "numerics/fit/missed_options.h"
#include "scripting/arguments/transfer_arguments.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OrderEntry kNc{"nc", "coefficients of C after the leading one"};
constexpr OrderEntry kNd{"nd", "coefficients of D after the leading one"};
constexpr std::array kNoiseModelOrders = {kNb, kNc, kNd, kNf, kNk};

int noise_order(const std::vector<int>& entry, const OrderEntry& what) {
    if (entry.size() == 1) return entry.front();
    throw InvalidArgument(
        fmt::format("{} is one number for the noise of the output, but {} were given", what.name, entry.size()));
}

int give_with_noise(Call& call, const IdData& data, const TransferRequest& request) {
    Fit result = request.estimate(data);
    if (!request.start_is_given && !request.integration) warn_of_missed_option(result, data, request.wanted);
    Estimate estimate = estimate_of(call.function_name(), result);
    estimate.of_coefficients = !request.integration;
    estimate.numbers.emplace_back("Ts", data.Ts);  // the samples that the noise model counts
    return give_fit(call, std::move(estimate), result);
}

TransferRequest noisy_request(const StructureMaker& structure, const NoiseOrders& noise, const Options& options,
                              const FitOptions& wanted) {
    return transfer_request(options, wanted,
                            [=](const IdData& data) { return rivc(data, structure(data), noise, wanted); });
}

TransferRequest read_rivc(const Call& call) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kNoiseModelOrders);
    const Options options(call, 3,
                          {"lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator",
                           "Integration", "Stable", "Fixed"});
    FitOptions wanted;
    read_fit_options(options, wanted);
    return noisy_request(structure_of_orders(kNoiseModelOrders, orders, sharing_of(options)),
                         {noise_order(orders[1], kNc), noise_order(orders[2], kNd)}, options, wanted);
}

TransferRequest read_tfrivc(const Call& call) {
    call.at_most(4);
    const Options options(
        call, 4,
        {"nc", "nd", "lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator", "Integration",
         "TdMin", "TdMax", "NumTd", "IODelay", "Stable", "Fixed"});
    FitOptions wanted;
    read_fit_options(options, wanted);
    const StructureMaker structure = structure_of_counts(call, options, wanted);
    const NoiseOrders noise{static_cast<int>(options.size("nc", 0)), static_cast<int>(options.size("nd", 1))};
    return noisy_request(structure, noise, options, wanted);
}

template <auto kRead>
int estimate_with_noise(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    return give_with_noise(call, data, kRead(call));
}

template <auto kRead>
Estimation read_estimation(const Call& call) {
    return kRead(call).estimate;
}

constexpr NamedReader kNoiseModelsReaders[] = {{"rivc", read_estimation<read_rivc>},
                                               {"tfrivc", read_estimation<read_tfrivc>}};

constexpr const char* kNoiseModelsArea = "continuous time";
constexpr std::array kNoiseModelsFunctions = {
    FunctionEntry{"rivc", kNoiseModelsArea, "rivc(data, {nb, nc, nd, nf, nk}, {lambda =, MaxIter =, Tol =, ...}) -> G",
                  "y = B/F u + C/D e, coloured noise modelled too",
                  guarded<memoized_call<estimate_with_noise<read_rivc>>>},
    FunctionEntry{"tfrivc", kNoiseModelsArea,
                  "tfrivc(data, np, nz, {nc =, nd =, TdMin =, TdMax =, IODelay =, ...}) -> G",
                  "rivc by numbers of poles and zeros, the delay estimated",
                  guarded<memoized_call<estimate_with_noise<read_tfrivc>>>},
};

}  // namespace

EstimationReaders noise_model_readers() {
    return kNoiseModelsReaders;
}

FunctionEntries noise_model_functions() {
    return kNoiseModelsFunctions;
}

}  // namespace dynlab::inline scripting
