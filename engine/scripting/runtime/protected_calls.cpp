#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

/// Stack: handler, true, results or the error. `skipped` values precede the results.
int finish_protected_call(lua_State* L, int status, lua_KContext) {
    if (status == LUA_OK || status == LUA_YIELD) return lua_gettop(L) - 1;
    pass_stop_on(L);
    if (status == LUA_ERRMEM) push_memory_error(L);
    lua_pushboolean(L, 0);
    lua_insert(L, -2);
    return 2;
}

int protected_call(lua_State* L) {
    luaL_checkany(L, 1);
    poll_stop(L);
    lua_pushcfunction(L, translate_error);
    lua_pushboolean(L, 1);
    lua_rotate(L, 1, 2);
    const int status = lua_pcallk(L, lua_gettop(L) - 3, LUA_MULTRET, 1, 0, finish_protected_call);
    return finish_protected_call(L, status, 0);
}

/// The script's own handler, which a stop does not wait for (hooks are off while it runs).
int call_script_handler(lua_State* L) {
    if (context_of(L).stop != StopReason::kNone) return 1;
    lua_settop(L, 1);
    translate_error(L);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, -2);
    lua_call(L, 1, 1);
    return 1;
}

int protected_call_with_handler(lua_State* L) {
    luaL_checktype(L, 2, LUA_TFUNCTION);
    poll_stop(L);
    lua_pushvalue(L, 2);
    lua_pushcclosure(L, call_script_handler, 1);
    lua_replace(L, 2);
    lua_pushboolean(L, 1);
    lua_rotate(L, 1, 1);  // true, f, handler, arguments
    lua_pushvalue(L, 3);
    lua_remove(L, 3);
    lua_insert(L, 1);  // handler, true, f, arguments
    const int status = lua_pcallk(L, lua_gettop(L) - 3, LUA_MULTRET, 1, 0, finish_protected_call);
    return finish_protected_call(L, status, 0);
}

constexpr int kFailed = -1;

/// Resumes `co` with the `count` values on top of L; the results or the error are then on top of L.
int resume_coroutine(lua_State* L, lua_State* co, int count) {
    if (!lua_checkstack(co, count)) {
        lua_pushliteral(L, "too many arguments to resume");
        return kFailed;
    }
    lua_xmove(L, co, count);
    int result_count = 0;
    lua_State*& active = context_of(L).active;
    active = co;
    const int status = lua_resume(co, L, count, &result_count);
    active = L;
    if (status != LUA_OK && status != LUA_YIELD) {
        pass_stop_on(L);
        if (status == LUA_ERRMEM) push_memory_error(co);
        lua_xmove(co, L, 1);
        translate_value_on_top(L);
        return kFailed;
    }
    if (!lua_checkstack(L, result_count + 1)) {
        lua_pop(co, result_count);
        lua_pushliteral(L, "too many results to resume");
        return kFailed;
    }
    lua_xmove(co, L, result_count);
    return result_count;
}

int coroutine_resume(lua_State* L) {
    lua_State* co = lua_tothread(L, 1);
    luaL_argexpected(L, co != nullptr, 1, "coroutine");
    poll_stop(L);
    const int count = resume_coroutine(L, co, lua_gettop(L) - 1);
    lua_pushboolean(L, count != kFailed);
    const int results = count == kFailed ? 1 : count;
    lua_insert(L, -results - 1);
    return results + 1;
}

int call_wrapped(lua_State* L) {
    lua_State* co = lua_tothread(L, lua_upvalueindex(1));
    poll_stop(L);
    const int count = resume_coroutine(L, co, lua_gettop(L));
    if (count != kFailed) return count;
    const int status = lua_status(co);
    if (status != LUA_OK && status != LUA_YIELD) lua_resetthread(co);
    return lua_error(L);
}

int coroutine_wrap(lua_State* L) {
    luaL_checktype(L, 1, LUA_TFUNCTION);
    lua_State* co = lua_newthread(L);
    lua_pushvalue(L, 1);
    lua_xmove(L, co, 1);
    lua_pushcclosure(L, call_wrapped, 1);
    return 1;
}

int coroutine_close(lua_State* L) {
    lua_State* co = lua_tothread(L, 1);
    luaL_argexpected(L, co != nullptr, 1, "coroutine");
    poll_stop(L);
    lua_Debug frame;
    const bool suspended = co != L && (lua_status(co) == LUA_YIELD || lua_getstack(co, 0, &frame) == 0);
    if (!suspended)
        raise_error(
            L, Message("{}: {}", "coroutine.close", Message("only a coroutine that is not running can be closed")));
    if (lua_resetthread(co) == LUA_OK) {
        lua_pushboolean(L, 1);
        return 1;
    }
    pass_stop_on(L);
    lua_pushboolean(L, 0);
    lua_xmove(co, L, 1);
    return 2;
}

}  // namespace

void add_protected_calls(lua_State* L) {
    set_function(L, "pcall", protected_call);
    set_function(L, "xpcall", protected_call_with_handler);
    lua_getfield(L, -1, "coroutine");
    set_function(L, "resume", coroutine_resume);
    set_function(L, "wrap", coroutine_wrap);
    set_function(L, "close", coroutine_close);
    lua_pop(L, 1);
}

}  // namespace dynlab::inline scripting
