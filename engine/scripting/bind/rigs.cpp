
#include "numerics/rigs/catalogue.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

void give_values(const Call& call, const RigValues& values, const std::string& path);

void give_value(const Call& call, const RigValue& value, const std::string& path) {
    if (const auto* number = std::get_if<double>(&value.value))
        call.give(*number);
    else if (const auto* samples = std::get_if<Vector>(&value.value))
        call.give_vector(*samples);
    else if (const auto* model = std::get_if<TransferFunction>(&value.value))
        give_model(call, *model);
    else
        give_values(call, std::get<RigValues>(value.value), path + "." + value.name);
}

/// Pushes a table of the values; `path` is the name by which messages speak of it, such as crane.steps.
void give_values(const Call& call, const RigValues& values, const std::string& path) {
    luaL_checkstack(call.state(), 4, "the values are nested too deeply");
    lua_createtable(call.state(), 0, static_cast<int>(values.size()));
    for (const RigValue& value : values) {
        give_value(call, value, path);
        lua_setfield(call.state(), -2, value.name.c_str());
    }
    refuse_unknown_fields(call.state(), path);
}

const Rig& rig_of(const Call& call) {
    const std::string name = call.text(1, "name");
    if (const Rig* rig = find_rig(name)) return *rig;
    std::vector<std::string> names;
    for (const Rig& rig : rig_catalogue()) names.push_back(rig.name);
    throw InvalidArgument("there is no rig '{}'; there are {}", name, listed(names));
}

std::uint32_t seed_number(const Options& options, const char* name, Index fallback) {
    const Index number = options.size(name, fallback);
    if (number > 0xFFFFFFFF) throw InvalidArgument("option '{}' must be a whole number from 0 to 4294967295", name);
    return static_cast<std::uint32_t>(number);
}

void give_description(const Call& call, const Rig& rig) {
    give_table(call, "title", rig.title, "Ts", rig.Ts);
    std::vector<std::string> signals;
    for (const RigSignal& signal : rig.signals) signals.push_back(signal.name);
    set_field(call, "signals", signals, "experiments", rig.experiments);
    lua_createtable(call.state(), 0, static_cast<int>(signals.size()));
    for (const RigSignal& signal : rig.signals)
        if (!signal.unit.empty()) set_field(call, signal.name.c_str(), signal.unit);
    lua_setfield(call.state(), -2, "units");
}

int give_descriptions(const Call& call) {
    lua_createtable(call.state(), 0, static_cast<int>(rig_catalogue().size()));
    for (const Rig& rig : rig_catalogue()) {
        give_description(call, rig);
        lua_setfield(call.state(), -2, rig.name.c_str());
    }
    return 1;
}

/// rig(name, {seed =, specimen =}): the course's experiments, with the parameters their headers state or another
/// specimen's; rig() tells which there are.
int rig(Call& call) {
    call.at_most(2);
    if (call.count() == 0) return give_descriptions(call);
    const Options options(call, 2, {"seed", "specimen"});
    const RigChoice stored;
    const RigChoice choice{seed_number(options, "specimen", stored.specimen),
                           seed_number(options, "seed", stored.seed)};
    const Rig& rig = rig_of(call);
    give_values(call, rig.record(choice), rig.name);
    return 1;
}

/// Where the script is graded, of a specimen that nobody has a record of: what theory says is there to be held against
/// an answer, not to be handed in as one.
int rig_truth(Call& call) {
    constexpr std::uint32_t kOfNobody = 0x8000'0000;
    call.at_most(2);
    const Options options(call, 2, {"specimen"});
    const Rig& rig = rig_of(call);
    const std::uint32_t specimen = seed_number(options, "specimen", 0);
    const bool graded = call.context().options.graded;
    give_values(call, rig.truth(graded ? specimen | kOfNobody : specimen), "the truth of " + rig.name);
    return 1;
}

constexpr FunctionEntry kRigsFunctions[] = {
    {"rig", "data", "rig(name, {seed =, specimen =}) -> table",
     "repeats one of the course's simulated experiments, with other noise for another seed",
     guarded<memoized_call<rig>>},
    {"rig_truth", "data", "rig_truth(name, {specimen =}) -> table",
     "what theory says of one of the course's simulated experiments", guarded<rig_truth>},
};

}  // namespace

FunctionEntries rig_functions() {
    return kRigsFunctions;
}

}  // namespace dynlab::inline scripting
