#include <array>

#include "numerics/rigs/catalogue.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kLargestRigSeed = 0xFFFFFFFF;
constexpr std::array kRigSeedOptions = {option<&RigChoice::seed>(
    "seed", about("seed of the noise and of random inputs"), {.least = 0, .most = kLargestRigSeed})};
constexpr std::array kRigSpecimenOptions = {
    option<&RigChoice::specimen>("specimen", about("number of the unit; 0 is the unit that `SOURCE.md` documents"),
                                 {.least = 0, .most = kLargestRigSeed})};
constexpr OptionTable kRigTables[] = {kRigSeedOptions, kRigSpecimenOptions}, kRigTruthTables[] = {kRigSpecimenOptions};

constexpr std::array kRigArguments = {
    ArgumentEntry{"name", ValueKind::kText,
                  about("\"crane\", \"drifting_process\", \"drive\", \"heat_exchanger\", \"heat_transfer\", "
                        "\"linear_system\", \"step_response\", \"suspension\", \"thruster\" or \"two_tanks\"")}};

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
    throw InvalidArgument("unknown simulated plant '{}'; the plants are {}", name, listed(names));
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

/// The course's experiments, with the parameters their headers state or another specimen's; rig() tells which there
/// are.
int rig(Call& call) {
    call.at_most(2);
    if (call.count() == 0) return give_descriptions(call);
    RigChoice choice;
    Options(call, 2, kRigTables).read(choice);
    const Rig& rig = rig_of(call);
    give_values(call, rig.record(choice), rig.name);
    return 1;
}

/// Where the script is graded, of a specimen that nobody has a record of: what theory says is there to be held against
/// an answer, not to be handed in as one.
int rig_truth(Call& call) {
    constexpr std::uint32_t kOfNobody = 0x8000'0000;
    call.at_most(2);
    RigChoice choice;
    Options(call, 2, kRigTruthTables).read(choice);
    const Rig& rig = rig_of(call);
    const bool graded = call.context().options.graded;
    give_values(call, rig.truth(graded ? choice.specimen | kOfNobody : choice.specimen), "the truth of " + rig.name);
    return 1;
}

constexpr FunctionEntry kRigsFunctions[] = {
    {"rig", "data", "rig(name, {options}) -> table",
     "Repeat a simulated experiment of the course, with other noise for another seed", guarded<memoized_call<rig>>,
     kRigTables, kRigArguments},
    {"rig_truth", "data", "rig_truth(name, {options}) -> table",
     "Return the theoretical values of a simulated experiment of the course", guarded<rig_truth>, kRigTruthTables,
     kRigArguments},
};

}  // namespace

FunctionEntries rig_functions() {
    return kRigsFunctions;
}

}  // namespace dynlab::inline scripting
