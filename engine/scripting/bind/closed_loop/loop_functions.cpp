#include <array>

#include "base/catalog.h"
#include "numerics/error.h"
#include "numerics/estimators/closed_loop/clivsvf.h"
#include "numerics/estimators/closed_loop/clsrivc.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/loop_arguments.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/estimation_readers.h"
#include "scripting/conversions/localized.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kLoopEquationOrders = {kNa, kNb, kNk};
constexpr std::array kLoopOutputOrders = {kNb, kNf, kNk};

constexpr std::array kSimloopOptions = {
    OptionEntry{"noise", ValueKind::kVector,
                about("N samples of noise, added to the output that the controller reads; by default, no noise")},
    option<&LoopController::computing_delay>(
        "ComputingDelay", about("delay in samples from reading y to the corresponding u, for sampled controllers")),
    OptionEntry{"hold",
                ValueKind::kChoice,
                about("intersample behavior of r for a continuous-time controller"),
                {.initial = "\"zoh\"", .choices = kHolds}}};
constexpr std::array kRouteNames = {"auxiliary", "direct", "indirect", "two-stage"};  // in the order of LoopRoute
constexpr OptionEntry kRoute = {"route",
                                ValueKind::kChoice,
                                about("method to estimate the plant"),
                                {.initial = "\"auxiliary\"", .choices = kRouteNames}};
constexpr std::array kRouteOptions = {
    kRoute, option<&FitOptions::lambda>("lambda",
                                        about("cutoff frequency of the filter of an initial estimate by clivsvf; by "
                                              "default, the two-stage route provides the initial estimate"),
                                        {.unit = "rad/s"})};
constexpr std::array kLoopEquationFilter = {kHoldOfOutput<SvfOptions>}, kLoopOutputFilter = {kHoldOfOutput<FitOptions>};
constexpr OptionTable kSimloop[] = {kSimloopOptions};
constexpr OptionTable kLoopEquation[] = {kLoopOptions, kLoopEquationFilter};
constexpr OptionTable kLoopOutput[] = {kLoopOptions, kRouteOptions, kLoopOutputFilter, kLimitOptions};

constexpr std::array kSimloopArguments = {
    ArgumentEntry{"G", ValueKind::kModel, about("continuous-time model of the plant")},
    ArgumentEntry{"C", ValueKind::kModel,
                  about("discrete-time controller with the sampling time Ts, or continuous-time controller; a number "
                        "is a continuous-time gain")},
    ArgumentEntry{"r", ValueKind::kVector, about("N samples of the reference")},
    ArgumentEntry{"Ts", ValueKind::kNumber, about("sampling time in seconds")}};
constexpr ArgumentEntry kLoopData = {
    "data", ValueKind::kData,
    about("data object with one input, one output and a reference, iddata(y, u, Ts, {Reference = r}); one or several "
          "experiments, regularly sampled, starting from rest")};
constexpr std::array kLoopEquationArguments = {
    kLoopData,
    ArgumentEntry{"orders", ValueKind::kOrders,
                  about("na poles, nb coefficients of B (at most na + 1), and an input delay of nk samples")},
    kFilterFrequency};
constexpr std::array kLoopOutputArguments = {
    kLoopData,
    ArgumentEntry{"orders", ValueKind::kOrders,
                  about("nb coefficients of B (at most nf + 1), nf poles, and an input delay of nk samples")}};

int simulate_loop(Call& call) {
    call.at_most(5);
    const Options options(call, 5, kSimloop);
    const TransferFunction plant = model_argument(call, 1, "G").G;
    LoopController controller = controller_at(call, 2);
    options.read(controller);
    const VectorMap r = call.vector(3, "r");
    if (r.size() < 2)
        throw InvalidArgument(
            "r must contain the reference at every sample, such as prbs(7, 5) or ones(500), but has {}",
            plural(r.size(), "{} value", "{} values"));
    const Hold hold = hold_option(options, Hold::kZoh);
    const Vector noise = options.has("noise") ? Vector(options.vector("noise")) : Vector::Zero(r.size());
    IdData data = ClosedLoop(plant, controller, call.number(4, "Ts"), hold).simulate(r, noise);
    if (!controller.sampled())
        call.print(
            localized(
                call,
                Message("simloop: with a continuous-time controller, u changes between the samples, but the data "
                        "contain u only at the samples. Models estimated from these data are biased. A controller with "
                        "the sampling time Ts holds u between the samples, so the data are exact.")) +
            "\n");
    const Vector x = data.experiments.front().y.col(0) - noise;
    return give_data(call, std::move(data)) + call.give_vector(x);
}

Estimation read_clivsvf(const Call& call) {
    call.at_most(4);
    const auto orders = order_lists(call, 2, kLoopEquationOrders);
    const Options options(call, 4, kLoopEquation);
    SvfOptions requested;
    requested.lambda = call.number(3, "lambda");
    options.read(requested);
    return [structure = structure_of_orders(kLoopEquationOrders, orders, Denominators::kPerOutput), requested,
            known = loop_knowledge(options)](const IdData& data) {
        return clivsvf(data, structure(data), requested, known);
    };
}

Estimation read_clsrivc(const Call& call) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kLoopOutputOrders);
    const Options options(call, 3, kLoopOutput);
    FitOptions requested;
    read_fit_options(options, requested);
    const auto route = options.has("route") ? static_cast<LoopRoute>(options.choice(kRoute)) : LoopRoute::kAuxiliary;
    return [structure = structure_of_orders(kLoopOutputOrders, orders, Denominators::kPerChannel), requested,
            known = loop_knowledge(options),
            route](const IdData& data) { return clsrivc(data, structure(data), requested, known, route); };
}

int estimate_clivsvf(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    return give_fit(call, "clivsvf", read_clivsvf(call)(data), FitForm::kEquationError);
}

int estimate_clsrivc(Call& call) {
    const IdData& data = object_argument<IdData>(call, 1, "data");
    return give_fit(call, "clsrivc", read_clsrivc(call)(data));
}

constexpr NamedReader kLoopReaders[] = {{"clivsvf", read_clivsvf}, {"clsrivc", read_clsrivc}};

constexpr FunctionEntry kLoopFunctions[] = {
    {"simloop", "simulation", "simloop(G, C, r, Ts, {options}) -> data, x",
     "Simulate a closed loop u = C (r - y) with output noise", guarded<simulate_loop>, kSimloop, kSimloopArguments},
    {"clivsvf", "continuous time", "clivsvf(data, {na, nb, nk}, lambda, {options}) -> G",
     marked("estimator", "Estimate a plant in closed loop, with the reference as instrument"),
     guarded<estimate_clivsvf>, kLoopEquation, kLoopEquationArguments},
    {"clsrivc", "continuous time", "clsrivc(data, {nb, nf, nk}, {options}) -> G",
     marked("estimator", "Estimate a plant in closed loop by refined instrumental variables"),
     guarded<memoized_call<estimate_clsrivc>>, kLoopOutput, kLoopOutputArguments},
};

}  // namespace

EstimationReaders loop_readers() {
    return kLoopReaders;
}

FunctionEntries loop_functions() {
    return kLoopFunctions;
}

}  // namespace dynlab::inline scripting
