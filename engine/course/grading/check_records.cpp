#include "course/grading/check_records.h"

#include <array>

#include "course/grading/check_session.h"
#include "scripting/arguments/arguments.h"
#include "scripting/arguments/table_fields.h"
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

/// A test asks for what is secret itself, so that it is known which messages must give nothing away.
void note_hidden(CheckSession& session) {
    if (!session.current) throw InvalidArgument("what is secret is asked for inside the test that looks at it");
    session.took_hidden = true;
}

int hidden(Call& call) {
    call.at_most(1);
    const std::string name = call.text(1, "name");
    CheckSession& session = service<CheckSession>(call.state());
    note_hidden(session);
    if (!session.specimens[kHiddenRecords].contains(name))
        throw InvalidArgument(fmt::format("there is no hidden record \"{}\": name a simulated experiment", name));
    call.give((session.hidden_folder / (name + ".mat")).string());
    call_library(call, "load", 1);
    return 1;
}

/// The run that a table of answers came from.
std::string run_of_answers(const Call& call, int index) {
    if (luaL_getmetafield(call.state(), index, kRunOfAnswers) != LUA_TSTRING)
        throw InvalidArgument("truth takes a hidden record's name, or answers and a data set's name");
    const std::string run = lua_tostring(call.state(), -1);
    lua_pop(call.state(), 1);
    return run;
}

/// The specimen whose truth is wanted, and of which data set.
std::pair<std::string, std::uint32_t> specimen_meant(const Call& call, CheckSession& session) {
    if (call.type(1) == LUA_TSTRING) {
        call.at_most(1);
        note_hidden(session);
        const std::string name = call.text(1, "name");
        const Specimens& hidden = session.specimens[kHiddenRecords];
        const auto found = hidden.find(name);
        if (found == hidden.end()) throw InvalidArgument(fmt::format("there is no hidden record \"{}\"", name));
        return *found;
    }
    call.at_most(2);
    const std::string run = run_of_answers(call, 1);
    const Specimens& own = session.specimens[run];
    const std::string name = call.given(2) ? call.text(2, "name") : run;
    const auto found = own.find(name);
    if (found != own.end()) return *found;
    if (!call.given(2)) throw InvalidArgument("name the data set whose truth is wanted: truth(a, \"crane\")");
    return {name, 0};
}

/// truth(name): of the hidden record; truth(b): of the record of the rerun; truth(a, name): of the record that the
/// script read.
int truth(Call& call) {
    const auto [name, specimen] = specimen_meant(call, service<CheckSession>(call.state()));
    call.give(name);
    lua_createtable(call.state(), 0, 1);
    set_field(call, "specimen", specimen);
    call_library(call, "rig_truth", 2);
    return 1;
}

constexpr std::array kRecordFunctions = {
    FunctionEntry{"hidden", "checks", "hidden(name) -> table", "a further record of the rerun's apparatus",
                  guarded<hidden>},
    FunctionEntry{"truth", "checks", "truth(name) | truth(answers, name) -> table", "what theory says of that record",
                  guarded<truth>},
};

}  // namespace

FunctionEntries check_record_functions() {
    return kRecordFunctions;
}

}  // namespace dynlab::inline course
