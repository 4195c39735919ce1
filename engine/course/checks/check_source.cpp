#include <algorithm>
#include <array>

#include "course/checks/check_functions.h"
#include "course/checks/check_session.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/context.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline course {
namespace {

using LuaTokens = std::vector<LuaToken>;

bool token_is(const LuaTokens& tokens, std::size_t k, std::string_view word) {
    return k < tokens.size() && tokens[k].is(word);
}

/// Whether a function or a local variable of this name is declared there: from then on it is the script's own.
bool declares(const LuaTokens& tokens, std::size_t k) {
    return k > 0 && (tokens[k - 1].is("function") || tokens[k - 1].is("local"));
}

/// Whether the name at k is used for its value: the script calls it, or passes it on under another name. A field and
/// the key in {name = value} do not count.
bool uses(const LuaTokens& tokens, std::size_t k) {
    const bool field = k > 0 && (tokens[k - 1].is(".") || tokens[k - 1].is(":"));
    return !field && !declares(tokens, k) && !token_is(tokens, k + 1, "=");
}

/// _G["name"] and its like.
bool looks_up(const LuaTokens& tokens, std::size_t k, std::string_view name) {
    const LuaToken& token = tokens[k];
    return token.kind == LuaToken::Kind::kString && token.text.size() == name.size() + 2 &&
           token.text.substr(1, name.size()) == name && k > 0 && tokens[k - 1].is("[");
}

bool names_function(const LuaTokens& tokens, std::string_view name) {
    for (std::size_t k = 0; k < tokens.size(); ++k) {
        if (looks_up(tokens, k, name)) return true;
        if (!tokens[k].is(name) || tokens[k].kind != LuaToken::Kind::kName) continue;
        if (uses(tokens, k)) return true;
        // In "local lssvf = lssvf" the second one is still the library's.
        if (declares(tokens, k) && !(token_is(tokens, k + 1, "=") && token_is(tokens, k + 2, name))) return false;
    }
    return false;
}

/// "report.value": the table's name, a dot, the field's.
bool names_field(const LuaTokens& tokens, std::string_view table, std::string_view field) {
    for (std::size_t k = 0; k + 2 < tokens.size(); ++k)
        if (tokens[k].is(table) && tokens[k + 1].is(".") && tokens[k + 2].is(field)) return true;
    return false;
}

int calls(Call& call) {
    call.at_most(1);
    const std::string name = call.text(1, "name");
    const LuaTokens tokens = lua_tokens(call.owner<CheckSession>().source);
    const std::size_t dot = name.find('.');
    return call.give(dot == std::string::npos
                         ? names_function(tokens, name)
                         : names_field(tokens, std::string_view(name).substr(0, dot), name.substr(dot + 1)));
}

int source(Call& call) {
    call.at_most(0);
    return call.give(call.owner<CheckSession>().source);
}

constexpr std::array kSourceFunctions = {
    FunctionEntry{"calls", "checks", "calls(name) -> true or false",
                  "whether the script uses a function of the library", guarded<calls>},
    FunctionEntry{"source", "checks", "source() -> text", "the student's script", guarded<source>},
};

}  // namespace

FunctionEntries check_source_functions() {
    return kSourceFunctions;
}

}  // namespace dynlab::inline course
