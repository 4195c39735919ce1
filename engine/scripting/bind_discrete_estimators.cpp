#include <array>

#include "numerics/estimators/arx.h"
#include "numerics/estimators/oe.h"
#include "numerics/estimators/sriv.h"
#include "scripting/bindings.h"
#include "scripting/estimation.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/model.h"
#include "scripting/order_vector.h"

namespace dynlab {
namespace {

constexpr OrderEntry kNb{"nb", "coefficients of B"};
constexpr OrderEntry kNk{"nk", "samples of delay, 1 for no direct term"};
constexpr std::array kArxOrders = {OrderEntry{"na", "poles"}, kNb, kNk};
constexpr std::array kOutputErrorOrders = {kNb, OrderEntry{"nf", "poles"}, kNk};

Estimate estimate_of(const char* method, const PolynomialEstimate& result) {
    Estimate estimate;
    estimate.method = method;
    estimate.names = result.names;
    estimate.theta = result.theta;
    estimate.std = result.std;
    estimate.covariance = result.covariance;
    estimate.message = result.message;
    estimate.warnings = result.warnings;
    estimate.converged = result.termination == Termination::kConverged;
    estimate.numbers = {
        {"fit_percent", result.fit_percent},           {"prediction_fit_percent", result.prediction_fit_percent},
        {"noise_variance", result.noise_variance},     {"loss", result.loss},
        {"condition_number", result.condition_number}, {"iterations", static_cast<double>(result.trace.size())}};
    Vector losses(static_cast<Index>(result.trace.size()));
    for (Index i = 0; i < losses.size(); ++i) losses[i] = result.trace[static_cast<std::size_t>(i)].loss;
    estimate.vectors = {{"offsets", result.offsets}, {"losses", losses}};
    return estimate;
}

int give_estimate(const Call& call, Estimate estimate, const PolynomialEstimate& result) {
    Model model{result.model.transfer_function()};
    model.estimate = std::make_shared<Estimate>(std::move(estimate));
    model.polynomial = std::make_shared<PolynomialModel>(result.model);
    push_object(call.state(), std::move(model));
    return 1;
}

int estimate_arx(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const auto orders = order_lists(call, 2, kArxOrders);
    if (orders[0].size() != 1)
        throw InvalidArgument(
            fmt::format("na is one number of poles for all inputs, but {} were given", orders[0].size()));
    const PolynomialEstimate result = arx(data, PolynomialOrders::arx(orders[0][0], orders[1], orders[2]));
    return give_estimate(call, estimate_of("arx", result), result);
}

PolynomialOptions polynomial_options(const Call& call, int index) {
    const Options options(call, index, {"InitialState", "Offset", "MaxIter", "Tol"});
    PolynomialOptions wanted;
    wanted.initial_state = parse_initial_state(options.text("InitialState", "zero"));
    wanted.offset = parse_offset(options.text("Offset", "none"));
    wanted.MaxIter = static_cast<int>(options.size("MaxIter", wanted.MaxIter));
    wanted.Tol = options.number("Tol", wanted.Tol);
    wanted.cancel = call.cancel();
    return wanted;
}

template <auto kMethod>
int estimate_output_error(Call& call) {
    call.at_most(3);
    const char* name = static_cast<const char*>(lua_touserdata(call.state(), lua_upvalueindex(1)));
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const auto orders = order_lists(call, 2, kOutputErrorOrders);
    const PolynomialOptions wanted = polynomial_options(call, 3);
    const PolynomialEstimate result =
        kMethod(data, PolynomialOrders::output_error(orders[0], orders[1], orders[2]), wanted);
    Estimate estimate = estimate_of(name, result);
    if (data.sample_count() <= kMostAssessed && result.std.allFinite())
        estimate.assessment = std::make_shared<Assessment>(assess(data, result, wanted.offset));
    return give_estimate(call, std::move(estimate), result);
}

constexpr const char* kArea = "discrete time";
constexpr std::array kFunctions = {
    FunctionEntry{"arx", kArea, "arx(data, {na, nb, nk}) -> G", "A y = B u + e by least squares",
                  guarded<estimate_arx>},
    FunctionEntry{"oe", kArea, "oe(data, {nb, nf, nk}, {InitialState =, Offset =, MaxIter =, Tol =}) -> G",
                  "y = B/F u + e with the smallest simulation error", guarded<estimate_output_error<oe>>},
    FunctionEntry{"sriv", kArea, "sriv(data, {nb, nf, nk}, {InitialState =, Offset =, MaxIter =, Tol =}) -> G",
                  "y = B/F u + e by refined instrumental variables", guarded<estimate_output_error<sriv>>},
};

}  // namespace

FunctionEntries discrete_estimator_functions() {
    return kFunctions;
}

}  // namespace dynlab
