#include <array>

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

/// simloop(G, C, r, Ts, {noise =, ComputingDelay =, hold =}) -> data, x
int simulate_loop(Call& call) {
    call.at_most(5);
    const Options options(call, 5, {"noise", "ComputingDelay", "hold"});
    const TransferFunction plant = model_argument(call, 1, "G").G;
    LoopController controller = controller_at(call, 2);
    controller.computing_delay = computing_delay_of(options);
    const VectorMap r = call.vector(3, "r");
    if (r.size() < 2)
        throw InvalidArgument("r is the reference at every sample, such as prbs(7, 5) or ones(500), and has {}",
                              plural(r.size(), "{} value", "{} values"));
    const Hold hold = hold_option(options, Hold::kZoh);
    const Vector noise = options.has("noise") ? Vector(options.vector("noise")) : Vector::Zero(r.size());
    if (!controller.sampled())
        call.print(
            localized(call,
                      Message("simloop: with a controller in continuous time u moves between the samples, and the "
                              "record knows it at the samples only: models found from it are off by what that "
                              "costs. A controller with the sampling time Ts holds u, which is exact.")) +
            "\n");
    IdData data = ClosedLoop(plant, controller, call.number(4, "Ts"), hold).record(r, noise);
    const Vector x = data.experiments.front().y.col(0) - noise;
    return give_data(call, std::move(data)) + call.give_vector(x);
}

Estimation read_clivsvf(const Call& call) {
    call.at_most(4);
    const auto orders = order_lists(call, 2, kLoopEquationOrders);
    const Options options(call, 4, {"controller", "ComputingDelay", "hold_r", "hold_y"});
    SvfOptions wanted;
    wanted.lambda = call.number(3, "lambda");
    wanted.hold_y = hold_y_of(options);
    return
        [structure = structure_of_orders(kLoopEquationOrders, orders, Denominators::kPerOutput), wanted,
         known = loop_knowledge(options)](const IdData& data) { return clivsvf(data, structure(data), wanted, known); };
}

Estimation read_clsrivc(const Call& call) {
    call.at_most(3);
    const auto orders = order_lists(call, 2, kLoopOutputOrders);
    const Options options(call, 3,
                          {"controller", "ComputingDelay", "hold_r", "route", "lambda", "hold_y", "MaxIter", "Tol"});
    FitOptions wanted;
    read_fit_options(options, wanted);
    constexpr std::array kRoutes = {LoopRoute::kAuxiliary, LoopRoute::kDirect, LoopRoute::kIndirect,
                                    LoopRoute::kTwoStage};
    const LoopRoute route = kRoutes[options.choice("route", {"auxiliary", "direct", "indirect", "two-stage"}, 0)];
    return [structure = structure_of_orders(kLoopOutputOrders, orders, Denominators::kPerChannel), wanted,
            known = loop_knowledge(options),
            route](const IdData& data) { return clsrivc(data, structure(data), wanted, known, route); };
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
    {"simloop", "simulation", "simloop(G, C, r, Ts, {noise =, ComputingDelay =, hold =}) -> data, x",
     "record of a closed loop u = C (r - y), with noise on the output", guarded<simulate_loop>},
    {"clivsvf", "continuous time", "clivsvf(data, {na, nb, nk}, lambda, {controller =, ComputingDelay =, ...}) -> G",
     "ivsvf for a record in closed loop, with the reference as instrument", guarded<estimate_clivsvf>},
    {"clsrivc", "continuous time", "clsrivc(data, {nb, nf, nk}, {controller =, route =, lambda =, ...}) -> G",
     "srivc for a record in closed loop, by four routes", guarded<memoized_call<estimate_clsrivc>>},
};

}  // namespace

EstimationReaders loop_readers() {
    return kLoopReaders;
}

FunctionEntries loop_functions() {
    return kLoopFunctions;
}

}  // namespace dynlab::inline scripting
