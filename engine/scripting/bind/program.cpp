#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/stopwatch.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/userdata.h"
#include "scripting/conversions/variable_list.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/output_path.h"
#include "scripting/runtime/prompt_statement.h"
#include "scripting/runtime/prompt_variables.h"
#include "scripting/runtime/shown_expressions.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

using Clock = std::chrono::steady_clock;

int tic(Call& call) {
    call.at_most(0);
    call.context().tic = Clock::now();
    return 0;
}

int toc(Call& call) {
    call.at_most(0);
    if (call.context().tic == Clock::time_point{}) throw InvalidArgument("call tic() before toc()");
    return call.give(seconds_since(call.context().tic));
}

int clock(Call& call) {
    call.at_most(0);
    return call.give(seconds_since(call.context().began));
}

/// "lib.tools" is lib/tools.lua in the script's folder.
std::filesystem::path file_of_module(const Call& call, const std::string& name) {
    const auto allowed = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), allowed) || name.find("..") != std::string::npos)
        throw InvalidArgument(
            "specify the name of a file in the script's folder without extension, such as \"tools\" for tools.lua, but "
            "\"{}\" was given",
            name);
    std::string relative = name;
    std::replace(relative.begin(), relative.end(), '.', '/');
    const std::filesystem::path folder = call.context().options.script_folder, file = folder / (relative + ".lua");
    call.context().recorder.note_file_read(file);  // also one that is not there: it may come
    if (!std::filesystem::is_regular_file(file))
        throw InvalidArgument(
            "file not found: {}.lua in the script's folder; scripts cannot use libraries in other folders", relative);
    if (!is_below_folder(file, folder)) throw InvalidArgument("{}.lua is outside the script's folder", relative);
    return file;
}

/// Runs a file of the script's folder once and gives what it returns, true when that is nothing.
int require_file(Call& call) {
    call.at_most(1);
    lua_State* L = call.state();
    const std::string name = call.text(1, "name");
    luaL_getsubtable(L, LUA_REGISTRYINDEX, "dynlab.required");
    const int known = lua_gettop(L);
    if (lua_getfield(L, known, name.c_str()) != LUA_TNIL) return 1;
    lua_pop(L, 1);
    const std::filesystem::path file = file_of_module(call, name);
    const std::string code = read_text(file);
    const std::string chunk = "@" + file.lexically_relative(call.context().options.script_folder).string();
    if (luaL_loadbufferx(L, code.data(), code.size(), chunk.c_str(), "t") != LUA_OK)
        throw InvalidArgument(syntax_error(lua_tostring(L, -1), code).with_place());
    lua_pushboolean(L, true);
    lua_setfield(L, known, name.c_str());  // a file that requires itself gets true
    lua_call(L, 0, 1);
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_pushboolean(L, true);
    }
    lua_pushvalue(L, -1);
    lua_setfield(L, known, name.c_str());
    return 1;
}

std::filesystem::path script_at(const std::string& path) {
    std::filesystem::path file = path;
    if (std::filesystem::is_directory(file)) file /= "analysis.lua";
    if (!std::filesystem::is_regular_file(file)) throw InvalidArgument("script not found: {}", file.string());
    return file;
}

/// load() looks beside the script while it runs.
class InFolder {
  public:
    InFolder(RunOptions& options, const std::filesystem::path& folder)
        : options_(options), before_(options.script_folder) {
        options.script_folder = folder.empty() ? std::filesystem::path(".") : folder;
    }
    ~InFolder() { options_.script_folder = before_; }
    InFolder(const InFolder&) = delete;
    InFolder& operator=(const InFolder&) = delete;

  private:
    RunOptions& options_;
    std::filesystem::path before_;
};

/// Its variables, local ones too, are the prompt's afterwards.
int run_file(Call& call) {
    call.at_most(1);
    lua_State* L = call.state();
    push_prompt_variables(L);
    if (lua_isnil(L, -1))
        throw InvalidArgument(
            "this function is available only at the prompt, which keeps the variables of a script; in a script, write "
            "require(name)");
    const std::filesystem::path file = script_at(call.text(1, "path"));
    const std::string text = read_text(file);
    const ShownCalls& shown = *call.context().shown_calls;
    const PromptStatement script = read_statement(with_shown_expressions(text, shown), shown);
    announce_variables(L, script.variables);
    const std::string chunk = "@" + file.string();
    if (luaL_loadbufferx(L, script.code.data(), script.code.size(), chunk.c_str(), "t") != LUA_OK)
        throw InvalidArgument(syntax_error(lua_tostring(L, -1), text).with_place());
    push_prompt_variables(L);
    lua_setupvalue(L, -2, 1);
    const InFolder folder(call.context().options, file.parent_path());
    lua_call(L, 0, 0);
    clear_unassigned(L, script.variables);
    return 0;
}

int who(Call& call) {
    call.at_most(0);
    const std::vector<ListedVariable> variables = variable_list(call.state());
    std::size_t width = 0;
    for (const ListedVariable& variable : variables) width = std::max(width, variable.name.size());
    for (const ListedVariable& variable : variables)
        call.print(fmt::format("{:<{}}  {}\n", variable.name, width, variable.text));
    return 0;
}

constexpr FunctionEntry kProgramFunctions[] = {
    {"require", "program", "require(name) -> value",
     "Run NAME.lua in the folder of the script only once, and return its value", guarded<require_file>},
    {"run", "program", "run(path)", "Run a script at the prompt and keep its variables", guarded<run_file>},
    {"who", "program", "who()", "List the variables and their values", guarded<who>},
    {"tic", "program", "tic()", "Start the stopwatch", guarded<tic>},
    {"toc", "program", "toc() -> seconds", "Elapsed time since tic()", guarded<toc>},
    {"clock", "program", "clock() -> seconds", "Elapsed time since the start of the script", guarded<clock>},
};

}  // namespace

FunctionEntries program_functions() {
    return kProgramFunctions;
}

}  // namespace dynlab::inline scripting
