#include "bench/lua_session.h"

#include <cstdlib>
#include <stdexcept>

#include "scripting/conversions/numeric.h"

namespace dynlab::bench {

LuaSession::LuaSession() : runtime_(options(), renderer_) {}

RunOptions LuaSession::options() {
    RunOptions options;
    options.script_folder = options.out_folder = folder_.path();
    options.call_cache = &calls_;
    return options;
}

Cache LuaSession::cache_below(const std::filesystem::path& folder) {
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    const Cache cache;
    unsetenv("XDG_CACHE_HOME");
    return cache;
}

void LuaSession::clear_results() {
    std::filesystem::remove_all(cache_.root());
}

void LuaSession::run(const std::string& line) {
    const RunRecord record = runtime_.run_code(line, "bench.lua");
    if (record.error) throw std::runtime_error(line + ": " + record.error->text());
}

Vector LuaSession::numbers(const std::string& expression) {
    run("bench_numbers = " + expression);
    lua_State* L = runtime_.state();
    lua_getglobal(L, "bench_numbers");
    NumericBlock* const block = to_vector(L, -1);
    if (!block) throw std::runtime_error(expression + " is no vector");
    const Vector values = block->vector();
    lua_pop(L, 1);
    return values;
}

}  // namespace dynlab::bench
