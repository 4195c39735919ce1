#include "course/checks/check_data.h"

#include <array>

#include "course/checks/check_session.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline course {
namespace {

void call_library(const Call& call, const char* name, int arguments) {
    lua_State* L = call.state();
    push_library(L);
    lua_getfield(L, -1, name);
    lua_remove(L, -2);
    lua_insert(L, -arguments - 1);
    lua_call(L, arguments, 1);
}

/// Pushes the result of a function of a declared simulated plant.
void call_of_plant(const Call& call, int function, std::uint32_t variant_number, std::uint32_t seed) {
    lua_State* L = call.state();
    lua_rawgeti(L, LUA_REGISTRYINDEX, function);
    give_table(call, "variant", variant_number, "seed", seed, "specimen", variant_number);  // its earlier name
    lua_call(L, 1, 1);
}

/// _record(name, variant, seed): stores a table of vectors in the session.
int simulated_data(Call& call) {
    CheckSession& session = call.owner<CheckSession>();
    const std::string name = call.text(1, "name");
    const auto whole = [&](int index) { return static_cast<std::uint32_t>(call.whole(index, "number")); };
    session.simulated_data.clear();
    lua_State* L = call.state();
    call_of_plant(call, session.plants.at(name).simulated_data, whole(2), whole(3));
    const int table = lua_gettop(L);
    if (lua_type(L, table) != LUA_TTABLE)
        throw InvalidArgument("the data set of the simulated plant \"{}\" must be a table of vectors", name);
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_settop(L, table + 1)) {
        if (lua_type(L, table + 1) != LUA_TSTRING)
            throw InvalidArgument("each signal of the simulated plant \"{}\" needs a name, as in {u = ..., y = ...}",
                                  name);
        const Call values(L);
        const VectorMap signal = values.vector(table + 2, lua_tostring(L, table + 1));
        session.simulated_data[lua_tostring(L, table + 1)] = {signal.begin(), signal.end()};
    }
    if (session.simulated_data.empty())
        throw InvalidArgument("the data set of the simulated plant \"{}\" is empty; return at least one signal", name);
    return 0;
}

/// A test asks for what is secret itself, so that it is known which messages must give nothing away.
void note_hidden(CheckSession& session) {
    if (!session.current)
        throw InvalidArgument(
            "hidden and truth give access to secret data only inside the test of a check; move the call into the test");
    session.took_hidden = true;
}

int hidden(Call& call) {
    call.at_most(1);
    const std::string name = call.text(1, "name");
    CheckSession& session = call.owner<CheckSession>();
    note_hidden(session);
    for (const char* ending : {".mat", ".csv"}) {
        const std::filesystem::path file = session.hidden_folder / (name + ending);
        if (name.find('/') != std::string::npos || !std::filesystem::exists(file)) continue;
        call.give(file.string());
        call_library(call, "load", 1);
        return 1;
    }
    throw InvalidArgument(
        "unknown hidden data set \"{}\". Give the name of a simulated plant, of a plant that the checks declare, or of "
        "a file in the folder \"hidden\" of the checks",
        name);
}

/// The run that a table of answers came from.
std::string run_of_answers(const Call& call, int index) {
    if (luaL_getmetafield(call.state(), index, kRunOfAnswers) != LUA_TSTRING)
        throw InvalidArgument(
            "truth requires the name of a hidden data set, or the answers and the "
            "name of a data set, as in truth(a, \"crane\")");
    const std::string run = lua_tostring(call.state(), -1);
    lua_pop(call.state(), 1);
    return run;
}

/// The plant variant and the data set whose true model is requested.
std::pair<std::string, std::uint32_t> requested_plant_variant(const Call& call, CheckSession& session) {
    if (call.type(1) == LUA_TSTRING) {
        call.at_most(1);
        note_hidden(session);
        const std::string name = call.text(1, "name");
        const PlantVariants& hidden = session.variants[kHiddenDataSets];
        const auto found = hidden.find(name);
        if (found == hidden.end())
            throw InvalidArgument(
                "no simulated hidden data set is named \"{}\", and only simulated data have true values", name);
        return *found;
    }
    call.at_most(2);
    const std::string run = run_of_answers(call, 1);
    const PlantVariants& own = session.variants[run];
    const std::string name = call.given(2) ? call.text(2, "name") : run;
    const auto found = own.find(name);
    if (found != own.end()) return *found;
    if (!call.given(2))
        throw InvalidArgument("give the data set for which you need the true values: truth(a, \"crane\")");
    return {name, 0};
}

/// truth(name): the true model of the hidden data set; truth(b): of the rerun's data set; truth(a, name): of the data
/// set that the script read.
int truth(Call& call) {
    CheckSession& session = call.owner<CheckSession>();
    const auto [name, variant_number] = requested_plant_variant(call, session);
    if (const auto own = session.plants.find(name); own != session.plants.end()) {
        if (own->second.truth == 0)
            throw InvalidArgument(
                "the simulated plant \"{}\" does not declare true values; add a function \"truth\" to its declaration",
                name);
        call_of_plant(call, own->second.truth, variant_number, variant_number);
        return 1;
    }
    call.give(name);
    give_table(call, "variant", variant_number);
    call_library(call, "true_model", 2);
    return 1;
}

constexpr std::array kHiddenDataFunctions = {
    FunctionEntry{"hidden", "checks", "hidden(name) -> table", "another data set of the rerun's plant",
                  guarded<hidden>},
    FunctionEntry{"truth", "checks", "truth(name) | truth(answers, name) -> table", "the true values of that data set",
                  guarded<truth>},
};

constexpr std::array kDataOfPlant = {
    FunctionEntry{"_record", "checks", "", "", guarded<simulated_data>},
};

}  // namespace

FunctionEntries data_function() {
    return kDataOfPlant;
}

FunctionEntries check_data_functions() {
    return kHiddenDataFunctions;
}

}  // namespace dynlab::inline course
