#include "scripting/runtime/call_chain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "platform/utf8.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::size_t kMaxChainLength = 6, kMaxArgumentLength = 40;
constexpr int kMaxArguments = 6, kMaxLevels = 100;

/// The first line of a value's text, cut where it is long.
std::string short_value_text(lua_State* L, int index) {
    if (lua_type(L, index) == LUA_TTABLE && luaL_getmetafield(L, index, "__tostring") != LUA_TNIL) {
        lua_pop(L, 1);
        return "table";  // the script's own function is not called while its error is reported
    }
    std::string text = value_text(L, index);
    if (lua_type(L, index) == LUA_TSTRING) text = '"' + text + '"';
    text = text.substr(0, text.find('\n'));
    const std::u32string characters = characters_in(text);
    return characters.size() <= kMaxArgumentLength ? text : utf8_of(characters.substr(0, kMaxArgumentLength)) + " ...";
}

/// "gain(x = 2)" for the activation of a function.
Message call_words(lua_State* L, lua_Debug& frame) {
    lua_getinfo(L, "nSu", &frame);
    if (std::string_view(frame.what) == "main") return Message("ran {}", frame.short_src);
    std::vector<std::string> arguments;
    const int count = std::min<int>(frame.nparams, kMaxArguments);
    for (int i = 1; i <= count; ++i) {
        const char* name = lua_getlocal(L, &frame, i);
        if (name == nullptr) break;
        arguments.push_back(fmt::format("{} = {}", name, short_value_text(L, -1)));
        lua_pop(L, 1);
    }
    if (frame.nparams > count || frame.isvararg != 0) arguments.emplace_back("...");
    const std::string given = fmt::format("({})", fmt::join(arguments, ", "));
    if (frame.name == nullptr) return Message("called the function defined in line {} {}", frame.linedefined, given);
    return Message("called {}", frame.name + given);
}

/// The vector's address is its argument.
int collect_calls(lua_State* L) {
    auto& calls = *static_cast<std::vector<RecordedCall>*>(lua_touserdata(L, 1));
    Message called;
    lua_Debug frame;
    for (int level = 0; level < kMaxLevels && lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline <= 0) continue;
        if (!called.empty()) {
            if (calls.size() == kMaxChainLength) {
                RuntimeContext& context = context_of(L);
                calls.push_back(
                    {Message("started a longer chain of calls"), context.script_name, main_chunk_line(context)});
                break;
            }
            calls.push_back({called, frame.short_src, frame.currentline});
        }
        called = call_words(L, frame);
    }
    return 0;
}

}  // namespace

std::vector<RecordedCall> call_chain(lua_State* L) {
    std::vector<RecordedCall> calls;
    if (lua_checkstack(L, 3) == 0) return calls;
    lua_pushcfunction(L, collect_calls);
    lua_pushlightuserdata(L, &calls);
    if (lua_pcall(L, 1, 0, 0) != LUA_OK) lua_pop(L, 1);  // too little stack or memory is left: what was found counts
    return calls;
}

}  // namespace dynlab::inline scripting
