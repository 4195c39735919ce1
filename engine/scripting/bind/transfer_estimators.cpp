#include <algorithm>
#include <array>

#include "base/catalog.h"
#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/lssvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/simulation_error.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/estimation_readers.h"
#include "scripting/bind/frequency/frequency_bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/frequency_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kCarxOrders = {kNa, kNb, kNk};
constexpr std::array kOutputErrorOrders = {kNb, kNf, kNk};

constexpr std::array kSvfFilterOptions = {kHoldOfOutput<SvfOptions>};
constexpr std::array kMomentOptions = {
    option<&SvfOptions::beta>("beta", about("gain of the filters; by default, `lambda`"), {.unit = "rad/s"}),
    kHoldOfOutput<SvfOptions>};
constexpr OptionTable kFiltered[] = {kSvfFilterOptions}, kMoments[] = {kMomentOptions};
constexpr OptionTable kRefined[] = {kFirstFilterOptions, kStartOptions,   kIterationOptions,
                                    kIntegrationOptions, kSharingOptions, kSearchOptions};
constexpr OptionTable kTransferFunction[] = {kFirstFilterOptions, kStartOptions,      kIterationOptions,
                                             kDelayOptions,       kKnownDelayOptions, kIntegrationOptions,
                                             kSharingOptions,     kSearchOptions};

constexpr ArgumentEntry kFilteredOrders = {
    "orders", ValueKind::kOrders,
    about("na poles, nb coefficients of B (at most na + 1), and an input delay of nk samples. With "
          "several inputs, nb and nk are tables with one entry per input; with several outputs, the "
          "tables have one entry per channel")};
constexpr std::array kFilteredArguments = {kDataArgument, kFilteredOrders, kFilterFrequency};
constexpr std::array kFilteredSignalArguments = {
    ArgumentEntry{"data", ValueKind::kData, about("data object with one or several inputs, outputs and experiments")},
    kFilteredOrders, kFilterFrequency};
constexpr std::array kRefinedArguments = {
    kDataArgument,
    ArgumentEntry{"orders", ValueKind::kOrders,
                  about("nb coefficients of B (at most nf + 1), nf poles, and an input delay of nk samples. With "
                        "several inputs, each with separate poles, nb, nf and nk are tables with one entry per input. "
                        "With several outputs, the tables have one entry per channel, output 1 first")}};
constexpr std::array kTransferFunctionArguments = {kDataArgument, kPoleCount, kZeroCount};

/// lssvf and ivsvf; lsgpmf and ivgpmf, whose filter has a gain beta.
struct FilteredCall {
    StructureMaker structure;
    SvfOptions options;
};

template <bool kMomentFunctionals>
FilteredCall filtered_call(const Call& call) {
    call.at_most(4);
    const auto orders = order_lists(call, 2, kCarxOrders);
    if (orders[0].size() != 1)
        throw InvalidArgument("na, the number of poles, must be one value for all inputs, but {} values were given",
                              orders[0].size());
    const Options options(call, 4, kMomentFunctionals ? OptionTables(kMoments) : OptionTables(kFiltered));
    SvfOptions requested;
    requested.lambda = call.number(3, "lambda");
    if constexpr (kMomentFunctionals) requested.beta = requested.lambda;
    options.read(requested);
    return {structure_of_orders(kCarxOrders, orders, Denominators::kPerOutput), requested};
}

template <auto kMethod, bool kInstruments, bool kMomentFunctionals>
Estimation read_filtered(const Call& call) {
    return [requested = filtered_call<kMomentFunctionals>(call)](const IdData& data) {
        Fit fit = kMethod(data, requested.structure(data), requested.options);
        color_covariance(fit, data, requested.options, kInstruments);
        return fit;
    };
}

/// The simulation and standard errors that know the filters' color take ten times as long as the estimate: they wait
/// until they are read, unless one of them has a warning.
template <auto kMethod, bool kInstruments, bool kMomentFunctionals>
int estimate_filtered(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const FilteredCall requested = filtered_call<kMomentFunctionals>(call);
    Fit found = kMethod(data, requested.structure(data), requested.options);
    if (data.sample_count() > kMaxColoredSamples) color_covariance(found, data, requested.options, kInstruments);
    if (!std::ranges::all_of(found.models, &TransferFunction::stable)) measure_simulation(found, data);
    const auto fit = std::make_shared<const Fit>(std::move(found));
    const auto shared = shared_object<IdData>(call.state(), 1);
    const auto measured = [fit, shared] {
        Fit copy = *fit;
        if (copy.fit_percent.size() == 0) measure_simulation(copy, *shared);
        return copy;
    };
    const auto with_errors = [fit, shared, options = requested.options] {
        Fit copy = *fit;
        if (shared->sample_count() <= kMaxColoredSamples) color_covariance(copy, *shared, options, kInstruments);
        return copy;
    };
    return give_deferring(
        call, deferred_estimate(call.function_name(), *fit, FitForm::kEquationError, measured, with_errors), *fit);
}

template <auto kMethod>
OptionedEstimation refined_estimation(const StartedStructure& started, const FitOptions& requested) {
    return {[=](const IdData& data) {
                const TransferStructure structure = started.structure(data);
                SearchAids aids = started.aids;
                if (aids.delays.size() == 1) aids.delays.resize(structure.channels.size(), aids.delays.front());
                return kMethod(data, structure, requested, aids);
            },
            requested};
}

/// srivc and coe: orders and fixed delays in samples.
template <auto kMethod>
OptionedEstimation read_refined(const Call& call, Purpose purpose) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kOutputErrorOrders);
    const Options options(call, 3, kRefined);
    return refined_estimation<kMethod>({structure_of_orders(kOutputErrorOrders, orders, sharing_of(options)), {}},
                                       fit_options(options, purpose));
}

/// tfsrivc and tfcoe: numbers of poles and zeros, and a delay that is estimated unless it is given.
template <auto kMethod>
OptionedEstimation read_transfer_function(const Call& call, Purpose purpose) {
    const int last = holds_model(call, 2) ? 3 : 4;
    call.at_most(last);
    const Options options(call, last, kTransferFunction);
    const FitOptions requested = fit_options(options, purpose);
    return refined_estimation<kMethod>(started_structure(call, options, requested), requested);
}

template <auto kRead>
int estimate_refined(Call& call) {
    if (holds_response(call, 1)) return fit_response(call);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const OptionedEstimation requested = kRead(call, Purpose::kModel);
    return give_diagnosed_fit(call, call.function_name(), requested.estimation(data), requested.options);
}

int estimate_by_least_squares(Call& call) {
    if (holds_response(call, 1)) return filter_response(call);
    return estimate_filtered<lssvf, false, false>(call);
}

constexpr NamedReader kTransferEstimatorsReaders[] = {{"lssvf", read_filtered<lssvf, false, false>},
                                                      {"ivsvf", read_filtered<ivsvf, true, false>},
                                                      {"lsgpmf", read_filtered<lssvf, false, true>},
                                                      {"ivgpmf", read_filtered<ivsvf, true, true>},
                                                      {"srivc", read_for_study<read_refined<srivc>>},
                                                      {"coe", read_for_study<read_refined<coe>>},
                                                      {"tfsrivc", read_for_study<read_transfer_function<srivc>>},
                                                      {"tfcoe", read_for_study<read_transfer_function<coe>>}};

constexpr FunctionEntry kTransferEstimatorsFunctions[] = {
    {"lssvf", "continuous time", "lssvf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate A y = B u + e by least squares on state-variable filtered signals"),
     guarded<estimate_by_least_squares>, kFiltered, kFilteredArguments},
    {"ivsvf", "continuous time", "ivsvf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate A y = B u + e by instrumental variables, without the bias of lssvf"),
     guarded<estimate_filtered<ivsvf, true, false>>, kFiltered, kFilteredSignalArguments},
    {"lsgpmf", "continuous time", "lsgpmf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate A y = B u + e by least squares on Poisson moment functionals"),
     guarded<estimate_filtered<lssvf, false, true>>, kMoments, kFilteredSignalArguments},
    {"ivgpmf", "continuous time", "ivgpmf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate A y = B u + e by instrumental variables on Poisson moment functionals"),
     guarded<estimate_filtered<ivsvf, true, true>>, kMoments, kFilteredSignalArguments},
    {"srivc", "continuous time", "srivc(data, {nb, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + e by refined instrumental variables"),
     guarded<memoized_call<estimate_refined<read_refined<srivc>>>>, kRefined, kRefinedArguments},
    {"coe", "continuous time", "coe(data, {nb, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + e by minimizing the simulation error"),
     guarded<memoized_call<estimate_refined<read_refined<coe>>>>, kRefined, kRefinedArguments},
    {"tfsrivc", "continuous time", "tfsrivc(data, np, nz, {options}) -> G; tfsrivc(data, G0, {options}) -> G",
     marked("estimator", "Estimate a transfer function with delay by refined instrumental variables"),
     guarded<memoized_call<estimate_refined<read_transfer_function<srivc>>>>, kTransferFunction,
     kTransferFunctionArguments},
    {"tfcoe", "continuous time", "tfcoe(data, np, nz, {options}) -> G; tfcoe(data, G0, {options}) -> G",
     marked("estimator", "Estimate a transfer function with delay by the output-error method"),
     guarded<memoized_call<estimate_refined<read_transfer_function<coe>>>>, kTransferFunction,
     kTransferFunctionArguments},
};

}  // namespace

EstimationReaders transfer_estimation_readers() {
    return kTransferEstimatorsReaders;
}

FunctionEntries transfer_estimator_functions() {
    return kTransferEstimatorsFunctions;
}

}  // namespace dynlab::inline scripting
