#include <array>

#include "numerics/plants/plant_catalog.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kMaxPlantSeed = 0xFFFFFFFF;
constexpr std::array kPlantSeedOptions = {option<&PlantChoice::seed>(
    "seed", about("seed of the noise and of random inputs"), {.minimum = 0, .maximum = kMaxPlantSeed})};
constexpr std::array kPlantVariantOptions = {option<&PlantChoice::variant_number>(
    "variant", about("number of the unit of the plant; 0 is the unit that `SOURCE.md` documents"),
    {.minimum = 0, .maximum = kMaxPlantSeed})};
constexpr OptionTable kPlantTables[] = {kPlantSeedOptions, kPlantVariantOptions},
                      kTrueModelTables[] = {kPlantVariantOptions};

constexpr std::array kPlantArguments = {
    ArgumentEntry{"name", ValueKind::kText,
                  about("\"crane\", \"drifting_process\", \"drive\", \"heat_exchanger\", \"heat_transfer\", "
                        "\"linear_system\", \"step_response\", \"suspension\", \"thruster\" or \"two_tanks\"")}};

void give_values(const Call& call, const PlantValues& values, const std::string& path);

void give_value(const Call& call, const PlantValue& value, const std::string& path) {
    if (const auto* number = std::get_if<double>(&value.value))
        call.give(*number);
    else if (const auto* samples = std::get_if<Vector>(&value.value))
        call.give_vector(*samples);
    else if (const auto* model = std::get_if<TransferFunction>(&value.value))
        give_model(call, *model);
    else
        give_values(call, std::get<PlantValues>(value.value), path + "." + value.name);
}

/// Pushes a table of the values; `path` is the name by which messages speak of it, such as crane.steps.
void give_values(const Call& call, const PlantValues& values, const std::string& path) {
    luaL_checkstack(call.state(), 4, "the values are nested too deeply");
    lua_createtable(call.state(), 0, static_cast<int>(values.size()));
    for (const PlantValue& value : values) {
        give_value(call, value, path);
        lua_setfield(call.state(), -2, value.name.c_str());
    }
    refuse_unknown_fields(call.state(), path);
}

const Plant& plant_of(const Call& call) {
    const std::string name = call.text(1, "name");
    if (const Plant* plant = find_plant(name)) return *plant;
    std::vector<std::string> names;
    for (const Plant& plant : plant_catalog()) names.push_back(plant.name);
    throw InvalidArgument("unknown simulated plant '{}'; the plants are {}", name, listed(names));
}

void give_description(const Call& call, const Plant& plant) {
    give_table(call, "title", plant.title, "Ts", plant.Ts);
    std::vector<std::string> signals;
    for (const PlantSignal& signal : plant.signals) signals.push_back(signal.name);
    set_field(call, "signals", signals, "experiments", plant.experiments);
    lua_createtable(call.state(), 0, static_cast<int>(signals.size()));
    for (const PlantSignal& signal : plant.signals)
        if (!signal.unit.empty()) set_field(call, signal.name.c_str(), signal.unit);
    lua_setfield(call.state(), -2, "units");
}

int give_descriptions(const Call& call) {
    lua_createtable(call.state(), 0, static_cast<int>(plant_catalog().size()));
    for (const Plant& plant : plant_catalog()) {
        give_description(call, plant);
        lua_setfield(call.state(), -2, plant.name.c_str());
    }
    return 1;
}

/// The course's experiments, with the parameters that their headers state or those of another plant variant; without
/// arguments, a list of the experiments.
int plant(Call& call) {
    call.at_most(2);
    if (call.count() == 0) return give_descriptions(call);
    PlantChoice choice;
    Options(call, 2, kPlantTables).read(choice);
    const Plant& plant = plant_of(call);
    give_values(call, plant.simulated_data(choice), plant.name);
    return 1;
}

/// In graded runs, the true model is that of a variant without any data set: an answer may be compared with theory, and
/// a theoretical value cannot be submitted as an answer.
int true_model(Call& call) {
    constexpr std::uint32_t kUnassignedVariant = 0x8000'0000;
    call.at_most(2);
    PlantChoice choice;
    Options(call, 2, kTrueModelTables).read(choice);
    const Plant& plant = plant_of(call);
    const bool graded = call.context().options.graded;
    give_values(call, plant.truth(graded ? choice.variant_number | kUnassignedVariant : choice.variant_number),
                fmt::format("true_model(\"{}\")", plant.name));
    return 1;
}

constexpr FunctionEntry kPlantFunctions[] = {
    {"plant", "data", "plant(name, {options}) -> table; plant() -> table",
     "Repeat a simulated experiment of the course; another seed changes the noise", guarded<memoized_call<plant>>,
     kPlantTables, kPlantArguments},
    {"true_model", "data", "true_model(name, {options}) -> table",
     "Return the theoretical values of a simulated experiment of the course", guarded<true_model>, kTrueModelTables,
     kPlantArguments},
};

}  // namespace

FunctionEntries plant_functions() {
    return kPlantFunctions;
}

}  // namespace dynlab::inline scripting
