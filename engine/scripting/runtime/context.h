#pragma once
#include <chrono>
#include <lua.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "numerics/signals/random.h"
#include "scripting/runtime/function_entry.h"
#include "scripting/runtime/memory_account.h"
#include "scripting/runtime/placed_message.h"
#include "scripting/runtime/recorder.h"
#include "scripting/runtime/run_options.h"
#include "scripting/runtime/services.h"
#include "scripting/runtime/shown_calls.h"
#include "scripting/runtime/type_entry.h"

namespace dynlab::inline scripting {

enum class StopReason { kNone, kInterrupted, kProcessorTime, kClockTime, kOutputLimit };

/// An error, and the text of it that Lua has.
struct RaisedError {
    std::string text;
    PlacedMessage error;
};

/// What the bindings of one Lua state share.
struct RuntimeContext {
    RuntimeContext(RunOptions run_options, GnuplotRenderer& shared_renderer)
        : options(std::move(run_options)),
          renderer(shared_renderer),
          memory(options.memory_limit_bytes),
          random(options.seed) {}

    RunOptions options;
    GnuplotRenderer& renderer;
    MemoryAccount memory;
    RandomStream random;
    Recorder recorder;
    std::vector<const FunctionEntry*> functions;             ///< all that scripts can call, later layers' too
    std::map<const ObjectType*, const TypeEntry*> types;     ///< all kinds of objects that scripts can hold
    std::string (*option_name)(std::string_view) = nullptr;  ///< for Reader::option_name
    const ShownCalls* shown_calls = nullptr;                 ///< calls that show their values when used as statements
    Services services;

    lua_State* main = nullptr;
    lua_State* active = nullptr;  ///< the coroutine that runs, or main
    std::string script_name;      ///< as messages show it
    std::string source;           ///< of the running script
    /// Where tic() was called last, and the script began.
    std::chrono::steady_clock::time_point tic{}, began = std::chrono::steady_clock::now();
    lua_Debug main_chunk{};  ///< activation of the running main chunk
    bool main_chunk_known = false;
    bool running = false;
    bool sampling_time_reported = false;     ///< that iddata took 1 s
    std::set<std::string> renamed_reported;  ///< earlier names of functions whose new name was printed
    bool time_unit_reported = false;         ///< that models say s where data count in another unit
    StopReason stop = StopReason::kNone;     ///< once set, every protected call passes the stop on
    std::shared_ptr<TimeBudget> budget;      ///< of the script, where it has limits
    std::string* printed_by_call = nullptr;  ///< also gets what is printed, while a call is watched
    int refusal_line = 0;                    ///< of the main chunk when memory was last refused
    RaisedError raised;                      ///< last, whether or not the script caught it
    std::vector<RecordedCall> calls;         ///< that led to the error which stopped the script
};

RuntimeContext& context_of(lua_State* L);

/// Line of the main chunk that runs now, 0 when none does.
int main_chunk_line(RuntimeContext& context);
/// The innermost script line; line 0 when no script is running.
struct ScriptPlace {
    std::string file;
    int line = 0;
};
ScriptPlace script_place(lua_State* L);
/// Raises the stop when Ctrl-C was pressed or a limit of time is reached; cheap enough for every protected call.
void poll_stop(lua_State* L);
/// Passes a stop on that is under way, whatever the script tried to catch.
void pass_stop_on(lua_State* L);
[[noreturn]] void raise_stop(lua_State* L, StopReason reason);
/// Adds to the run results and prints at once; raises the stop at the limit of output.
void print_text(lua_State* L, const std::string& text);
/// Pushes the text of an error, for scripts to catch, and keeps the error for that text.
void push_error(lua_State* L, PlacedMessage error);
/// Raises it with the place of the script's line.
[[noreturn]] void raise_error(lua_State* L, const Message& message);

}  // namespace dynlab::inline scripting
