#include <array>

#include "numerics/rigs/first_order_step.h"
#include "numerics/rigs/heat_exchanger.h"
#include "numerics/rigs/suspension.h"
#include "scripting/bindings.h"
#include "scripting/objects/boxed.h"

namespace dynlab {
namespace {

void give_columns(const Call& call, std::initializer_list<std::pair<const char*, const Vector*>> columns) {
    lua_createtable(call.state(), 0, static_cast<int>(columns.size()));
    for (const auto& [name, values] : columns) {
        call.give_vector(*values);
        lua_setfield(call.state(), -2, name);
    }
}

void give_record(const Call& call, const RigRecord& record) {
    give_columns(call, {{"t", &record.t}, {"u", &record.u}, {"y", &record.y}});
}

/// rig(name, {seed =}): the course's experiments, with the parameters their headers state.
int rig(Call& call) {
    call.at_most(2);
    const Options options(call, 2, {"seed"});
    const Index seed = options.size("seed", 1);
    if (seed > 0xFFFFFFFF) throw InvalidArgument("option 'seed' must be a whole number from 0 to 4294967295");
    const auto draws = static_cast<std::uint32_t>(seed);
    const std::string name = call.text(1, "name");
    if (name == "heat_exchanger") {
        give_record(call, simulate_heat_exchanger({}, draws));
    } else if (name == "suspension") {
        give_record(call, simulate_suspension({}, draws));
    } else if (name == "step_response") {
        const FirstOrderStepRecord record = simulate_first_order_step({}, draws);
        give_columns(call, {{"t", &record.t},
                            {"u", &record.u},
                            {"y", &record.y},
                            {"ydot", &record.ydot},
                            {"y_noisy", &record.y_noisy},
                            {"ydot_noisy", &record.ydot_noisy}});
    } else {
        throw InvalidArgument(
            fmt::format("there is no experiment '{}'; there are heat_exchanger, suspension and step_response", name));
    }
    return 1;
}

constexpr std::array kFunctions = {
    FunctionEntry{"rig", "data", "rig(name, {seed =}) -> table",
                  "repeats one of the course's simulated experiments, with other noise for another seed", guarded<rig>},
};

}  // namespace

FunctionEntries rig_functions() {
    return kFunctions;
}

}  // namespace dynlab
