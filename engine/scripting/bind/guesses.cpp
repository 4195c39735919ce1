#include <array>
#include <cmath>

#include "scripting/arguments/arguments.h"
#include "scripting/bind/bindings.h"
#include "scripting/runtime/report_language.h"

namespace dynlab::inline scripting {
namespace {

constexpr const char* kGuesses = "dynlab guesses";  // in Lua's registry: a table for each name

/// Pushes the table of all guesses.
void push_guesses(lua_State* L) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, kGuesses);
}

bool in_french(const Call& call) {
    return report_language_of(call.context()) == "fr";
}

std::string with_unit(double value, const std::string& unit) {
    const std::string number = fmt::format("{:.4g}", value);
    return unit.empty() ? number : number + " " + unit;
}

/// How far a guess lies from what was found, in its percents.
std::string distance(double guessed, double found, bool french) {
    if (found == 0 || !std::isfinite(found) || !std::isfinite(guessed)) return "";
    const double percent = 100 * std::abs(guessed / found - 1);
    const std::string shown = percent < 10 ? fmt::format("{:.1g}", percent) : fmt::format("{:.0f}", percent);
    return fmt::format(fmt::runtime(french ? " (écart de {} %)" : " (off by {} %)"), shown);
}

int guess(Call& call) {
    call.at_most(3);
    lua_State* const L = call.state();
    const std::string name = call.text(1, "name");
    const std::string unit = call.given(3) ? call.text(3, "unit") : "";
    push_guesses(L);
    if (lua_getfield(L, -1, name.c_str()) != LUA_TNIL)
        throw InvalidArgument(
            fmt::format("\"{}\" was guessed already; a guess is made once, before it is looked up", name));
    lua_pop(L, 1);
    lua_createtable(L, 0, 2);
    if (call.given(2)) {
        lua_pushnumber(L, call.number(2, "your guess"));
        lua_setfield(L, -2, "value");
    } else {
        call.print(fmt::format(
            fmt::runtime(in_french(call) ? "{} : pas encore deviné ; écrivez votre nombre à la place de nil\n"
                                         : "{}: not guessed yet; type your number in the place of nil\n"),
            name));
    }
    lua_pushstring(L, unit.c_str());
    lua_setfield(L, -2, "unit");
    lua_setfield(L, -2, name.c_str());
    return 0;
}

int outcome(Call& call) {
    call.at_most(2);
    lua_State* const L = call.state();
    const std::string name = call.text(1, "name");
    const double found = call.number(2, "what was found");
    const bool french = in_french(call);
    push_guesses(L);
    if (lua_getfield(L, -1, name.c_str()) != LUA_TTABLE)
        throw InvalidArgument(
            fmt::format("nothing called \"{}\" was guessed before; write guess(\"{}\", 1) above", name, name));
    lua_getfield(L, -1, "unit");
    const std::string unit = lua_tostring(L, -1), shown = with_unit(found, unit);
    if (lua_getfield(L, -2, "value") == LUA_TNIL) {
        call.print(fmt::format(fmt::runtime(french ? "{} : trouvé {}, non deviné\n" : "{}: found {}, not guessed\n"),
                               name, shown));
        return 0;
    }
    const double guessed = lua_tonumber(L, -1);
    call.print(fmt::format(fmt::runtime(french ? "{} : deviné {}, trouvé {}{}\n" : "{}: guessed {}, found {}{}\n"),
                           name, with_unit(guessed, unit), shown, distance(guessed, found, french)));
    return 0;
}

constexpr std::array kGuessFunctions = {
    FunctionEntry{"guess", "report", "guess(name, value, unit)", "writes down what you expect before you look",
                  guarded<guess>},
    FunctionEntry{"outcome", "report", "outcome(name, value)", "prints a guess beside what was found",
                  guarded<outcome>},
};

}  // namespace

FunctionEntries guess_functions() {
    return kGuessFunctions;
}

}  // namespace dynlab::inline scripting
