#include "scripting/runtime/context.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "platform/interrupt.h"

namespace dynlab::inline scripting {
namespace {

/// The activation of the outermost call of a thread: the main chunk.
bool outermost_call(lua_State* L, lua_Debug& frame) {
    int inside = 0, outside = 1;
    while (lua_getstack(L, outside, &frame)) {
        inside = outside;
        outside *= 2;
    }
    while (inside + 1 < outside) {
        const int middle = (inside + outside) / 2;
        (lua_getstack(L, middle, &frame) ? inside : outside) = middle;
    }
    return lua_getstack(L, inside, &frame) != 0;
}

ScriptPlace innermost_line(lua_State* L) {
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame); ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline > 0) return {frame.short_src, frame.currentline};
    }
    return {};
}

Message stop_sentence(const RuntimeContext& context, StopReason reason) {
    switch (reason) {
        case StopReason::kProcessorTime:
            return Message("the script used more than {} s of processor time",
                           context.options.time->seconds(TimeLimit::kProcessor));
        case StopReason::kClockTime:
            return Message("the script did not finish within {} s", context.options.time->seconds(TimeLimit::kClock));
        case StopReason::kOutputLimit:
            return Message(
                "the script printed more than the limit of {}; "
                "print fewer values, for example not in every iteration of a loop",
                size_phrase(static_cast<double>(context.options.output_limit_bytes)));
        default:
            return Message("interrupted");
    }
}

}  // namespace

RuntimeContext& context_of(lua_State* L) {
    return **static_cast<RuntimeContext**>(lua_getextraspace(L));
}

int main_chunk_line(RuntimeContext& context) {
    if (!context.running) return 0;
    if (!context.main_chunk_known) context.main_chunk_known = outermost_call(context.main, context.main_chunk);
    if (!context.main_chunk_known) return 0;
    lua_getinfo(context.main, "l", &context.main_chunk);
    return std::max(context.main_chunk.currentline, 0);
}

ScriptPlace script_place(lua_State* L) {
    ScriptPlace place = innermost_line(L);
    lua_State* main = context_of(L).main;
    return place.line == 0 && main != L ? innermost_line(main) : place;
}

void poll_stop(lua_State* L) {
    RuntimeContext& context = context_of(L);
    pass_stop_on(L);
    if (interrupted()) raise_stop(L, StopReason::kInterrupted);
    switch (context.budget ? context.budget->reached() : TimeLimit::kNone) {
        case TimeLimit::kProcessor:
            raise_stop(L, StopReason::kProcessorTime);
        case TimeLimit::kClock:
            raise_stop(L, StopReason::kClockTime);
        case TimeLimit::kNone:
            break;
    }
}

void pass_stop_on(lua_State* L) {
    const StopReason reason = context_of(L).stop;
    if (reason != StopReason::kNone) raise_stop(L, reason);
}

void raise_stop(lua_State* L, StopReason reason) {
    RuntimeContext& context = context_of(L);
    context.stop = reason;
    lua_sethook(L, lua_gethook(L), LUA_MASKCOUNT, 1);  // so that a loop around pcall ends at its next step
    lua_sethook(context.main, lua_gethook(L), LUA_MASKCOUNT, 1);
    raise_error(L, stop_sentence(context, reason));
}

void print_text(lua_State* L, const std::string& text) {
    RuntimeContext& context = context_of(L);
    if (context.recorder.printed_bytes() + text.size() > context.options.output_limit_bytes)
        raise_stop(L, StopReason::kOutputLimit);
    context.recorder.print(text);
    if (context.printed_by_call) *context.printed_by_call += text;
    if (context.options.print) context.options.print(text);
}

void push_error(lua_State* L, PlacedMessage error) {
    std::string text = error.text();
    lua_pushlstring(L, text.data(), text.size());
    context_of(L).raised = {std::move(text), std::move(error)};
}

void raise_error(lua_State* L, const Message& message) {
    ScriptPlace place = script_place(L);
    push_error(L, {message, std::move(place.file), place.line});
    lua_error(L);
    std::abort();  // not reached: lua_error does not return
}

}  // namespace dynlab::inline scripting
