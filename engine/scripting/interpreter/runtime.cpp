#include "scripting/interpreter/runtime.h"

#include <cstring>
#include <utility>

#include "base/languages.h"
#include "numerics/error.h"
#include "platform/error.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/restricted_library.h"
#include "scripting/runtime/call_chain.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/prompt_variables.h"
#include "scripting/runtime/sandbox.h"
#include "scripting/runtime/shown_expressions.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kInstructionsBetweenPolls = 10'000;

void count_hook(lua_State* L, lua_Debug*) {
    RuntimeContext& context = context_of(L);
    if (context.stop == StopReason::kNone) context.recorder.note_time();
    poll_stop(L);
}

/// Handler of the outermost call: always leaves a sentence.
int final_message(lua_State* L) {
    translate_error(L);
    context_of(L).calls = call_chain(L);
    if (lua_type(L, 1) == LUA_TSTRING) return 1;
    ScriptPlace place = script_place(L);
    push_error(L, {lua_isnil(L, 1) ? Message("error() was called without a message; write error(\"message\")")
                                   : Message::verbatim(value_text(L, 1)),
                   std::move(place.file), place.line});
    return 1;
}

int open_library(lua_State* L) {
    open_safe_libraries(L);
    add_restricted_functions(L);
    lua_setfield(L, LUA_REGISTRYINDEX, "dynlab.library");
    return 0;
}

struct OwnedFunctions {
    FunctionEntries entries;
    void* owner;
};

/// Sets a function, "report.value" as field of the table `report`, in the table on top.
void register_function(lua_State* L, const FunctionEntry& entry, void* owner) {
    const int top = lua_gettop(L);
    const char* name = entry.name;
    if (const char* dot = std::strchr(name, '.')) {
        const std::string table(entry.name, dot);
        if (luaL_getsubtable(L, -1, table.c_str()) == 0) lua_settop(L, top + 1);
        name = dot + 1;
    }
    lua_pushlightuserdata(L, const_cast<char*>(entry.name));
    lua_pushlightuserdata(L, owner);
    lua_pushcclosure(L, entry.function, 2);
    lua_setfield(L, -2, name);
    lua_settop(L, top);
}

int register_functions(lua_State* L) {
    const auto& added = *static_cast<const OwnedFunctions*>(lua_touserdata(L, 1));
    lua_getfield(L, LUA_REGISTRYINDEX, "dynlab.library");
    for (const FunctionEntry& entry : added.entries) register_function(L, entry, added.owner);
    return 0;
}

int seal(lua_State* L) {
    lua_getfield(L, LUA_REGISTRYINDEX, "dynlab.library");
    seal_library(L);
    lua_pushboolean(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, "dynlab.sealed");
    return 0;
}

int seal_once(lua_State* L) {
    if (lua_getfield(L, LUA_REGISTRYINDEX, "dynlab.sealed") == LUA_TNIL) seal(L);
    return 0;
}

int prepare_variables(lua_State* L) {
    push_prompt_variables(L);
    if (lua_isnil(L, -1)) make_prompt_variables(L);
    announce_variables(L, *static_cast<const std::vector<std::string>*>(lua_touserdata(L, 1)));
    return 0;
}

int tidy_variables(lua_State* L) {
    clear_unassigned(L, *static_cast<const std::vector<std::string>*>(lua_touserdata(L, 1)));
    return 0;
}

/// Calls the chunk below it and prints the values it returns: show(...).
int show_values(lua_State* L) {
    lua_call(L, 0, LUA_MULTRET);
    push_library(L);
    lua_getfield(L, -1, "show");
    lua_remove(L, -2);
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 0);
    return 0;
}

PercentScript single_cell(const std::string& code, const std::string& name) {
    PercentScript script;
    script.file = name;
    script.source = code;
    Cell cell;
    cell.id = "cell-1";
    cell.content = code;
    script.cells.push_back(std::move(cell));
    return script;
}

/// Calls `function` in protected mode: what fails here is our own mistake or a memory limit far too small.
void call_protected(lua_State* L, lua_CFunction function, const void* argument = nullptr) {
    lua_pushcfunction(L, function);
    lua_pushlightuserdata(L, const_cast<void*>(argument));
    if (lua_pcall(L, 1, 0, 0) == LUA_OK) return;
    const std::string message = lua_tostring(L, -1);
    lua_pop(L, 1);
    throw InvalidArgument("the script engine could not be set up: {}", message);
}

}  // namespace

Runtime::Runtime(RunOptions options, GnuplotRenderer& renderer)
    : context_(std::make_unique<RuntimeContext>(std::move(options), renderer)) {
    lua_State* L = lua_newstate(MemoryAccount::allocate, &context_->memory);
    if (L == nullptr)
        throw InvalidArgument("the memory limit of {} is too small to start a script; increase the limit",
                              size_phrase(static_cast<double>(context_->memory.limit())));
    context_->main = L;
    *static_cast<RuntimeContext**>(lua_getextraspace(L)) = context_.get();
    context_->memory.on_refusal = [context = context_.get()] {
        const int line = main_chunk_line(*context);
        if (line > 0) context->refusal_line = line;
    };
    call_protected(L, open_library);
    for (const TypeEntry& entry : catalog_of_types()) context_->types.emplace(entry.type, &entry);
    context_->shown_calls = &shown_calls();
    context_->option_name = option_name;
    add_functions(catalog_of_functions(), nullptr);
}

Runtime::~Runtime() {
    lua_close(context_->main);
}

void Runtime::add_functions(FunctionEntries entries, void* owner) {
    const OwnedFunctions added{entries, owner};
    call_protected(context_->main, register_functions, &added);
    for (const FunctionEntry& entry : entries) context_->functions.push_back(&entry);
}

Services& Runtime::services() {
    return context_->services;
}

RunRecord Runtime::run(const PercentScript& script) {
    return run_recorded(script, [&] { run_source(with_shown_expressions(script.source, shown_calls()), nullptr); });
}

RunRecord Runtime::run_code(const std::string& code, const std::string& name) {
    return run(single_cell(code, name));
}

RunRecord Runtime::run_library(const std::string& code, const std::string& name) {
    return run_recorded(single_cell(code, name), [&] { run_chunk(code, nullptr); });
}

RunRecord Runtime::run_statement(const PromptStatement& statement, const std::string& name) {
    return run_recorded(single_cell(statement.source, name), [&] { run_with_variables(statement); });
}

void Runtime::begin_parts(const PercentScript& script) {
    prepare(script);
    begin_recording(script);
}

RunRecord Runtime::run_part(const PercentScript& script, const ScriptPart& part) {
    prepare(script);
    context_->recorder.follow(script);
    run_with_variables(
        read_script_part(std::string(static_cast<std::size_t>(part.first_line) - 1, '\n') + part.code, shown_calls()));
    RunRecord record = context_->recorder.so_far({catalog_of(context_->services.language_code())});
    throw_if_stopped();
    return record;
}

void Runtime::run_with_variables(const PromptStatement& statement) {
    call_protected(context_->main, prepare_variables, &statement.variables);
    run_source(statement.code, &statement);
    call_protected(context_->main, tidy_variables, &statement.variables);
}

void Runtime::prepare(const PercentScript& script) {
    RuntimeContext& context = *context_;
    call_protected(context.main, seal_once);
    lua_settop(context.main, 0);
    context.script_name = script.file.filename().string();
    context.source = script.source;
    context.refusal_line = 0;
    context.calls.clear();
    context.main_chunk_known = false;
    if (context.options.time) context.budget = std::make_shared<TimeBudget>(*context.options.time);
}

void Runtime::begin_recording(const PercentScript& script) {
    RuntimeContext& context = *context_;
    context.began = std::chrono::steady_clock::now();
    context.recorder.start(
        script, context.options.seed, [&context] { return main_chunk_line(context); }, context.options.enter_cell);
}

void Runtime::throw_if_stopped() {
    lua_settop(context_->main, 0);
    if (std::exchange(context_->stop, StopReason::kNone) == StopReason::kInterrupted) throw Interrupted();
}

RunRecord Runtime::run_recorded(const PercentScript& script, const std::function<void()>& work) {
    prepare(script);
    begin_recording(script);
    work();
    RunRecord record = context_->recorder.finish({catalog_of(context_->services.language_code())});
    throw_if_stopped();
    return record;
}

void Runtime::run_source(const std::string& source, const PromptStatement* statement) {
    if (const std::optional<MisreadLine> misread = misread_line_of(source))
        return record_error({misread->sentence, context_->script_name, misread->line});
    run_chunk(source, statement);
}

/// A statement has the prompt's variables as its environment and is called by show_values when its values are wanted.
void Runtime::run_chunk(const std::string& source, const PromptStatement* statement) {
    RuntimeContext& context = *context_;
    lua_State* L = context.main;
    lua_pushcfunction(L, final_message);
    const bool shows = statement != nullptr && !statement->silent;
    if (shows) lua_pushcfunction(L, show_values);
    const std::string chunk_name = "@" + context.script_name;
    int status = luaL_loadbufferx(L, source.data(), source.size(), chunk_name.c_str(), "t");
    if (status == LUA_OK) {
        if (statement != nullptr) {
            push_prompt_variables(L);
            lua_setupvalue(L, -2, 1);
        }
        lua_sethook(L, count_hook, LUA_MASKCOUNT, kInstructionsBetweenPolls);
        context.active = L;
        context.running = true;
        status = lua_pcall(L, shows ? 1 : 0, 0, 1);
        context.running = false;
        lua_sethook(L, nullptr, 0, 0);
        if (status != LUA_OK) record_error(error_of_run(status));
    } else {
        const std::string& text = statement != nullptr ? statement->source : context.source;
        record_error(status == LUA_ERRMEM ? memory_error(context) : syntax_error(lua_tostring(L, -1), text));
    }
}

/// As Lua's own interpreter does on SIGINT.
void Runtime::stop_at_next_step() {
    if (context_->running) lua_sethook(context_->active, count_hook, LUA_MASKCOUNT, 1);
}

PlacedMessage Runtime::error_of_run(int status) const {
    if (status == LUA_ERRMEM) return memory_error(*context_);
    lua_State* L = context_->main;
    return lua_type(L, -1) == LUA_TSTRING ? error_at(L, -1) : PlacedMessage{Message("the script failed")};
}

void Runtime::record_error(PlacedMessage error) {
    RuntimeContext& context = *context_;
    context.recorder.record().error =
        RecordedError{std::move(error.message), std::move(error.file), error.line, std::move(context.calls)};
}

std::size_t Runtime::peak_memory_bytes() const {
    return context_->memory.peak();
}

std::size_t Runtime::memory_bytes() const {
    lua_gc(context_->main, LUA_GCCOLLECT);
    return context_->memory.used();
}

lua_State* Runtime::state() {
    return context_->main;
}

}  // namespace dynlab::inline scripting
