#include <array>

#include "base/catalog.h"
#include "numerics/estimators/armax.h"
#include "numerics/estimators/arx.h"
#include "numerics/estimators/bj.h"
#include "numerics/estimators/iv4.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "numerics/fit/integrated_input.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OrderEntry kDiscreteNb{"nb", [] { return Message("coefficients of B"); }};
constexpr OrderEntry kDiscreteNk{
    "nk", [] { return Message("samples of input delay, 1 for systems without direct feedthrough"); }};
constexpr OrderEntry kDiscreteNa{"na", [] { return Message("poles"); }},
    kDiscreteNf{"nf", [] { return Message("poles"); }};
constexpr OrderEntry kDiscreteNc{"nc", [] { return Message("coefficients of C without the leading 1"); }};
constexpr OrderEntry kDiscreteNd{"nd", [] { return Message("coefficients of D without the leading 1"); }};
constexpr std::array kArxOrders = {kDiscreteNa, kDiscreteNb, kDiscreteNk};
constexpr std::array kArmaxOrders = {kDiscreteNa, kDiscreteNb, kDiscreteNc, kDiscreteNk};
constexpr std::array kDiscreteOutputErrorOrders = {kDiscreteNb, kDiscreteNf, kDiscreteNk};
constexpr std::array kBoxJenkinsOrders = {kDiscreteNb, kDiscreteNc, kDiscreteNd, kDiscreteNf, kDiscreteNk};

constexpr std::array kDiscreteIntegration = {option<&FitOptions::integration>(
    "Integration", about("true adds an integrator to the model: B/(1 - q^-1) replaces B"), {.member = "integration"})};
constexpr OptionTable kEquationError[] = {kDiscreteIntegration};
constexpr OptionTable kPredictionError[] = {kLimitOptions, kDiscreteIntegration};
constexpr OptionTable kDiscreteSimulation[] = {kStartOptions, kDiscreteIntegration, kLimitOptions};

constexpr std::array kEquationErrorArguments = {
    kOneOutputData,
    ArgumentEntry{
        "orders", ValueKind::kOrders,
        about("na poles, nb coefficients of B, and an input delay of nk samples. Specify nk = 1 for systems without "
              "direct feedthrough. With several inputs, nb and nk are tables, such as {2, {1, 2}, {1, 3}}")}};
constexpr std::array kArmaxArguments = {
    kOneOutputData, ArgumentEntry{"orders", ValueKind::kOrders,
                                  about("na poles, nb coefficients of B, nc coefficients of C without the leading 1, "
                                        "and an input delay of nk samples. Specify nk = 1 for systems without direct "
                                        "feedthrough. With several inputs, nb and nk are tables")}};
constexpr std::array kDiscreteOutputErrorArguments = {
    kOneOutputData, ArgumentEntry{"orders", ValueKind::kOrders,
                                  about("nb coefficients of B, nf poles, and an input delay of nk samples. Specify nk "
                                        "= 1 for systems without direct feedthrough. With several inputs, each with "
                                        "separate poles, nb, nf and nk are tables, such as {{2, 1}, {2, 1}, {1, 3}}")}};
constexpr std::array kBoxJenkinsArguments = {
    kOneOutputData,
    ArgumentEntry{"orders", ValueKind::kOrders,
                  about("nb coefficients of B, nc, nd and nf coefficients of C, D and F without the leading 1, and an "
                        "input delay of nk samples. Specify nk = 1 for systems without direct feedthrough. With "
                        "several inputs, nb, nf and nk are tables")}};

/// The entry of an order vector that is one number for all inputs.
int only_value(const std::vector<int>& entry, const OrderEntry& what) {
    if (entry.size() == 1) return entry.front();
    throw InvalidArgument("{}, the number of {}, must be one value for all inputs, but {} values were given", what.name,
                          what.meaning(), entry.size());
}

template <auto kMethod>
int estimate_equation_error(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const auto orders = order_lists(call, 2, kArxOrders);
    const bool integration = Options(call, 3, kEquationError).flag("Integration", false);
    Fit result = kMethod(integration ? summed_inputs(data) : data,
                         PolynomialOrders::arx(only_value(orders[0], kDiscreteNa), orders[1], orders[2]));
    if (integration) append_integrator(result);
    return give_fit(call, call.function_name(), result);
}

/// oe, sriv and bj.
template <auto kMethod>
int estimate_simulation(Call& call, const PolynomialOrders& orders) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 3, kDiscreteSimulation);
    const FitOptions requested = fit_options(options, Purpose::kModel);
    return give_diagnosed_fit(call, call.function_name(), kMethod(data, orders, requested), requested);
}

template <auto kMethod>
int estimate_output_error(Call& call) {
    call.at_most(3);
    object_argument<IdData>(call, 1, "data");
    const auto orders = order_lists(call, 2, kDiscreteOutputErrorOrders);
    return estimate_simulation<kMethod>(call, PolynomialOrders::output_error(orders[0], orders[1], orders[2]));
}

int estimate_armax(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const auto lists = order_lists(call, 2, kArmaxOrders);
    PolynomialOrders orders = PolynomialOrders::arx(only_value(lists[0], kDiscreteNa), lists[1], lists[3]);
    orders.nc = only_value(lists[2], kDiscreteNc);
    const Options options(call, 3, kPredictionError);
    const FitOptions requested = fit_options(options, Purpose::kModel);
    return give_diagnosed_fit(call, "armax", armax(data, orders, requested), requested);
}

int estimate_bj(Call& call) {
    call.at_most(3);
    object_argument<IdData>(call, 1, "data");
    const auto lists = order_lists(call, 2, kBoxJenkinsOrders);
    PolynomialOrders orders = PolynomialOrders::output_error(lists[0], lists[3], lists[4]);
    orders.nc = only_value(lists[1], kDiscreteNc);
    orders.nd = only_value(lists[2], kDiscreteNd);
    return estimate_simulation<bj>(call, orders);
}

constexpr FunctionEntry kDiscreteEstimatorsFunctions[] = {
    {"arx", "discrete time", "arx(data, {na, nb, nk}, {options}) -> G",
     marked("estimator", "Estimate A y = B u + e by least squares"), guarded<estimate_equation_error<arx>>,
     kEquationError, kEquationErrorArguments},
    {"iv4", "discrete time", "iv4(data, {na, nb, nk}, {options}) -> G",
     marked("estimator", "Estimate A y = B u + v by instrumental variables in four steps"),
     guarded<memoized_call<estimate_equation_error<iv4>>>, kEquationError, kEquationErrorArguments},
    {"armax", "discrete time", "armax(data, {na, nb, nc, nk}, {options}) -> G",
     marked("estimator", "Estimate A y = B u + C e by minimizing the prediction error"),
     guarded<memoized_call<estimate_armax>>, kPredictionError, kArmaxArguments},
    {"oe", "discrete time", "oe(data, {nb, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + e by minimizing the simulation error"),
     guarded<memoized_call<estimate_output_error<oe>>>, kDiscreteSimulation, kDiscreteOutputErrorArguments},
    {"sriv", "discrete time", "sriv(data, {nb, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + e by refined instrumental variables"),
     guarded<memoized_call<estimate_output_error<sriv>>>, kDiscreteSimulation, kDiscreteOutputErrorArguments},
    {"bj", "discrete time", "bj(data, {nb, nc, nd, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate y = B/F u + C/D e by minimizing the prediction error"),
     guarded<memoized_call<estimate_bj>>, kDiscreteSimulation, kBoxJenkinsArguments},
};

}  // namespace

FunctionEntries discrete_estimator_functions() {
    return kDiscreteEstimatorsFunctions;
}

}  // namespace dynlab::inline scripting
