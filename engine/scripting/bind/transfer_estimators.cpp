#include <array>

#include "numerics/estimators/coe.h"
#include "numerics/estimators/ivsvf.h"
#include "numerics/estimators/lssvf.h"
#include "numerics/estimators/srivc.h"
#include "numerics/fit/simulation_error.h"
#include "scripting/arguments/estimator_arguments.h"
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

/// lssvf and ivsvf; lsgpmf and ivgpmf, whose filter has a gain beta. Their standard errors know the filters' colour.
template <auto kMethod, bool kInstruments, bool kMomentFunctionals>
Estimation read_filtered(const Call& call) {
    call.at_most(4);
    const auto orders = order_lists(call, 2, kCarxOrders);
    if (orders[0].size() != 1)
        throw InvalidArgument("na is one number of poles for all inputs, but {} were given", orders[0].size());
    const Options options = kMomentFunctionals ? Options(call, 4, {"hold_y", "beta"}) : Options(call, 4, {"hold_y"});
    SvfOptions wanted;
    wanted.lambda = call.number(3, "lambda");
    wanted.hold_y = hold_y_of(options);
    if constexpr (kMomentFunctionals) wanted.beta = options.optional_number("beta").value_or(wanted.lambda);
    return
        [structure = structure_of_orders(kCarxOrders, orders, Denominators::kPerOutput), wanted](const IdData& data) {
            Fit fit = kMethod(data, structure(data), wanted);
            colour_covariance(fit, data, wanted, kInstruments);
            return fit;
        };
}

template <auto kMethod, bool kInstruments, bool kMomentFunctionals>
int estimate_filtered(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    Fit result = read_filtered<kMethod, kInstruments, kMomentFunctionals>(call)(data);
    measure_simulation(result, data);
    return give_fit(call, call.function_name(), result, FitForm::kEquationError);
}

template <auto kMethod>
OptionedEstimation refined_estimation(const StartedStructure& started, const FitOptions& wanted) {
    return {[=](const IdData& data) {
                const TransferStructure structure = started.structure(data);
                SearchAids aids = started.aids;
                if (aids.delays.size() == 1) aids.delays.resize(structure.channels.size(), aids.delays.front());
                return kMethod(data, structure, wanted, aids);
            },
            wanted};
}

/// srivc and coe: orders and fixed delays in samples.
template <auto kMethod>
OptionedEstimation read_refined(const Call& call, Purpose purpose) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kOutputErrorOrders);
    const Options options(call, 3,
                          {"lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator",
                           "Integration", "Stable", "Fixed", "OutputWeights"});
    return refined_estimation<kMethod>({structure_of_orders(kOutputErrorOrders, orders, sharing_of(options)), {}},
                                       fit_options(options, purpose));
}

/// tfsrivc and tfcoe: numbers of poles and zeros, and a delay that is estimated unless it is given.
template <auto kMethod>
OptionedEstimation read_transfer_function(const Call& call, Purpose purpose) {
    const int last = holds_model(call, 2) ? 3 : 4;
    call.at_most(last);
    const Options options(
        call, last,
        {"lambda", "hold_y", "InitialState", "Offset", "MaxIter", "Tol", "CommonDenominator", "Integration", "TdMin",
         "TdMax", "NumTd", "IODelay", "Td0", "Stable", "Fixed", "OutputWeights"});
    const FitOptions wanted = fit_options(options, purpose);
    return refined_estimation<kMethod>(started_structure(call, options, wanted), wanted);
}

template <auto kRead>
int estimate_refined(Call& call) {
    if (holds_response(call, 1)) return fit_response(call);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const OptionedEstimation wanted = kRead(call, Purpose::kModel);
    return give_diagnosed_fit(call, call.function_name(), wanted.estimation(data), wanted.options);
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
    {"lssvf", "continuous time", "lssvf(data, {na, nb, nk}, lambda, {hold_y =}) -> G",
     "A y = B u + e by least squares on state-variable filtered signals", guarded<estimate_by_least_squares>},
    {"ivsvf", "continuous time", "ivsvf(data, {na, nb, nk}, lambda, {hold_y =}) -> G",
     "the same by instrumental variables, without lssvf's bias", guarded<estimate_filtered<ivsvf, true, false>>},
    {"lsgpmf", "continuous time", "lsgpmf(data, {na, nb, nk}, lambda, {beta =, hold_y =}) -> G",
     "least squares on Poisson moment functionals", guarded<estimate_filtered<lssvf, false, true>>},
    {"ivgpmf", "continuous time", "ivgpmf(data, {na, nb, nk}, lambda, {beta =, hold_y =}) -> G",
     "instrumental variables on Poisson moment functionals", guarded<estimate_filtered<ivsvf, true, true>>},
    {"srivc", "continuous time", "srivc(data, {nb, nf, nk}, {lambda =, MaxIter =, Tol =, ...}) -> G",
     "y = B/F u + e by refined instrumental variables", guarded<memoized_call<estimate_refined<read_refined<srivc>>>>},
    {"coe", "continuous time", "coe(data, {nb, nf, nk}, {lambda =, MaxIter =, Tol =, ...}) -> G",
     "y = B/F u + e with the smallest simulation error", guarded<memoized_call<estimate_refined<read_refined<coe>>>>},
    {"tfsrivc", "continuous time", "tfsrivc(data, np, nz, {TdMin =, TdMax =, IODelay =, Stable =, ...}) -> G",
     "srivc by numbers of poles and zeros, the delay estimated",
     guarded<memoized_call<estimate_refined<read_transfer_function<srivc>>>>},
    {"tfcoe", "continuous time", "tfcoe(data, np, nz, {TdMin =, TdMax =, IODelay =, Stable =, ...}) -> G",
     "coe by numbers of poles and zeros, the delay estimated",
     guarded<memoized_call<estimate_refined<read_transfer_function<coe>>>>},
};

}  // namespace

EstimationReaders transfer_estimation_readers() {
    return kTransferEstimatorsReaders;
}

FunctionEntries transfer_estimator_functions() {
    return kTransferEstimatorsFunctions;
}

}  // namespace dynlab::inline scripting
