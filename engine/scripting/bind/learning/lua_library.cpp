#include "scripting/bind/learning/lua_library.h"

#include <memory>

#include "scripting/arguments/script_function.h"

namespace dynlab::inline scripting {
namespace {

struct ChannelNames {
    std::vector<std::string> states, inputs;
};

Message more_than_a_list() {
    return Message("the library must return one list, as in return {x[1], x[1]*x[2]}, but it returned several values");
}

/// A table of the columns as vectors, by place and by name.
void push_channels(lua_State* L, const char* kind, const char* table, const std::vector<std::string>& names,
                   const Matrix& columns) {
    push_by_name(L, kind, table, names, [&](Index j) { push_vector(L, columns.rows()).vector() = columns.col(j); });
}

/// The values of one function, on top of the stack, as a column.
void read_function(lua_State* L, lua_Integer place, Eigen::Ref<Vector> column) {
    if (lua_type(L, -1) == LUA_TNUMBER) {
        column.setConstant(lua_tonumber(L, -1));
        return;
    }
    NumericBlock* block = to_vector(L, -1);
    if (block == nullptr)
        throw InvalidArgument("function {} of the library must return a vector or a number, but returned {}", place,
                              given_value(L, -1));
    if (block->vector().size() != column.size())
        throw InvalidArgument(
            "function {} of the library returned {} for {}; it must return one value per sample, or one number", place,
            plural(block->vector().size(), "{} value", "{} values"), plural(column.size(), "{} sample", "{} samples"));
    column = block->vector();
}

Matrix call_library(const ScriptFunction& function, const ChannelNames& names, const Matrix& X, const Matrix& U) {
    lua_State* L = function.state();
    const int top = lua_gettop(L);
    luaL_checkstack(L, 8, "library of functions");
    function.push();
    push_channels(L, "state", "x", names.states, X);
    push_channels(L, "input", "u", names.inputs, U);
    call_or_throw(L, 2, 1, more_than_a_list);
    if (lua_type(L, -1) != LUA_TTABLE || lua_rawlen(L, -1) == 0)
        throw InvalidArgument(
            "the library must return a list of vectors, as in function(x, u) return {x[1], x[1]*x[2]} end, but it "
            "returned {}",
            given_value(L, -1));
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, -1));
    Matrix values(X.rows(), count);
    for (lua_Integer j = 1; j <= count; ++j) {
        lua_rawgeti(L, -1, j);
        read_function(L, j, values.col(j - 1));
        lua_pop(L, 1);
    }
    lua_settop(L, top);
    return values;
}

}  // namespace

FunctionLibrary lua_library(const Call& call, int index, const IdData& data, std::vector<std::string> names) {
    const auto function = std::make_shared<const ScriptFunction>(call.state(), index);
    const ChannelNames channels{data.output_names, data.input_names};
    FunctionLibrary library;
    library.values = [function, channels](const Matrix& X, const Matrix& U) {
        return call_library(*function, channels, X, U);
    };
    const Experiment& first = data.experiments.front();
    const Index count = library.values(first.y, first.u).cols();
    if (!names.empty() && static_cast<Index>(names.size()) != count)
        throw InvalidArgument("option 'names' has {}, but the library returns {}; specify one name per function",
                              plural(names.size(), "{} string", "{} strings"),
                              plural(count, "{} function", "{} functions"));
    for (Index j = static_cast<Index>(names.size()); j < count; ++j) names.push_back(fmt::format("f{}", j + 1));
    library.names = std::move(names);
    return library;
}

}  // namespace dynlab::inline scripting
