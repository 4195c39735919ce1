#include "scripting/prompt/inspection.h"

#include <vector>

#include "numerics/error.h"
#include "scripting/conversions/value_members.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/help.h"
#include "scripting/runtime/text_form.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

using NameChain = std::vector<std::string_view>;

/// The names joined by dots and colons that end with the name at the cursor; where there is none there, the last
/// before.
NameChain chain_at(std::string_view text, std::size_t cursor) {
    const std::vector<LuaToken> tokens = lua_tokens(text);
    std::size_t at = tokens.size();
    for (std::size_t i = 0; i < tokens.size() && tokens[i].begin <= cursor; ++i)
        if (tokens[i].kind == LuaToken::Kind::kName) at = i;
    if (at == tokens.size()) return {};
    NameChain chain = {tokens[at].text};
    while (at >= 2 && (tokens[at - 1].is(".") || tokens[at - 1].is(":")) &&
           tokens[at - 2].kind == LuaToken::Kind::kName)
        chain.insert(chain.begin(), tokens[at -= 2].text);
    return chain;
}

struct Inspected {
    const NameChain& chain;
    std::optional<std::string> text;
};

int read_inspected(lua_State* L) {
    auto& request = *static_cast<Inspected*>(lua_touserdata(L, 1));
    if (push_value_of(L, request.chain) && !lua_isnil(L, -1) && !lua_isfunction(L, -1))
        request.text = value_text(L, -1);
    return 0;
}

std::optional<std::string> help_of_chain(lua_State* L, const NameChain& chain) {
    std::string name;
    for (const std::string_view link : chain) name += (name.empty() ? "" : ".") + std::string(link);
    try {
        return help_text(name, context_of(L).functions);
    } catch (const InvalidArgument&) {
        return {};
    }
}

}  // namespace

std::optional<std::string> inspect(lua_State* L, std::string_view text, std::size_t cursor) {
    const NameChain chain = chain_at(text, cursor);
    if (chain.empty()) return {};
    Inspected request{chain, {}};
    const int top = lua_gettop(L);
    lua_pushcfunction(L, read_inspected);
    lua_pushlightuserdata(L, &request);
    lua_pcall(L, 1, 0, 0);
    lua_settop(L, top);
    return request.text ? request.text : help_of_chain(L, chain);
}

}  // namespace dynlab::inline scripting
