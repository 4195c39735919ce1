#include <array>
#include <string_view>

#include "numerics/estimators/frequency/frequency_fit.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/frequency/frequency_bindings.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/frequency_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kCarxOrders = {kNa, kNb, kNk};
constexpr std::array kOutputErrorOrders = {kNb, kNf, kNk};

constexpr std::array kStableOptions = {kStableOption};
constexpr OptionTable kResponseFit[] = {kIterationOptions, kStableOptions};
constexpr OptionTable kDelayedResponseFit[] = {kIterationOptions, kStableOptions, kDelayOptions, kFixedDelayOptions};

/// Data of the same channels and sampling time, without samples: what structures are made for.
IdData channels_of(const FrequencyData& response) {
    IdData data;
    data.experiments.resize(1);
    data.experiments.front().y.resize(0, 1), data.experiments.front().u.resize(0, 1);
    data.Ts = response.Ts;
    return data;
}

TransferStructure ordered_structure(const Call& call, const FrequencyData& response,
                                    const std::array<OrderEntry, 3>& entries) {
    const auto orders = order_lists(call, 2, entries);
    const bool delayed = std::any_of(orders[2].begin(), orders[2].end(), [](int nk) { return nk > 0; });
    if (delayed && response.Ts == 0)
        throw InvalidArgument(
            "nk is a delay in samples, which is undefined for a response without Ts; specify nk = 0, or use tfsrivc "
            "with IODelay in seconds");
    return structure_of_orders(entries, orders, Denominators::kPerOutput)(channels_of(response));
}

int give_response_fit(const Call& call, const FrequencyData& response, const Fit& fit, FitForm form) {
    Estimate estimate = estimate_of(call.function_name(), fit, form);
    estimate.fields.edit().numbers.emplace_back("frequencies", static_cast<double>(response.w.size()));
    return give_estimate(call, std::move(estimate), fit);
}

TransferStructure structure_for_response(const Call& call, const FrequencyData& response, FitOptions& requested) {
    if (!std::string_view(call.function_name()).starts_with("tf")) {
        call.at_most(3);
        read_fit_options(Options(call, 3, kResponseFit), requested);
        return ordered_structure(call, response, kOutputErrorOrders);
    }
    call.at_most(4);
    const Options options(call, 4, kDelayedResponseFit);
    read_fit_options(options, requested);
    return structure_of_counts(call, options, requested)(channels_of(response));
}

}  // namespace

int fit_response(Call& call) {
    const FrequencyData& response = object_argument<FrequencyData>(call, 1, "F");
    FitOptions requested;
    const TransferStructure structure = structure_for_response(call, response, requested);
    return give_response_fit(call, response, frequency_fit(call.function_name(), response, structure, requested),
                             FitForm::kOutputError);
}

int filter_response(Call& call) {
    call.at_most(3);
    const FrequencyData& response = object_argument<FrequencyData>(call, 1, "F");
    const TransferStructure structure = ordered_structure(call, response, kCarxOrders);
    SvfOptions requested;
    requested.lambda = call.number(3, "lambda");
    return give_response_fit(call, response, frequency_lssvf(response, structure, requested), FitForm::kEquationError);
}

}  // namespace dynlab::inline scripting
