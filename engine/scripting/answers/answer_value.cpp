#include "scripting/answers/answer_value.h"

#include <fmt/format.h>

#include "documents/percent_script.h"
#include "scripting/answers/answer_json.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

using nlohmann::json;

constexpr int kDeepest = 8;
constexpr Index kMostNumbers = 500'000;

json of_kind(const char* kind, json fields) {
    fields["kind"] = kind;
    return fields;
}

/// Makes the JSON of one value; what it holds is counted, as tables may share others.
class Writer {
  public:
    explicit Writer(lua_State* state) : L(state) {}

    json value(int index, int depth) {
        switch (lua_type(L, index)) {
            case LUA_TNUMBER:
                count(1);
                return of_kind("number", {{"value", json_of_number(lua_tonumber(L, index))}});
            case LUA_TBOOLEAN:
                count(1);
                return of_kind("truth", {{"value", lua_toboolean(L, index) != 0}});
            case LUA_TSTRING:
                return text(index);
            case LUA_TTABLE:
                return table(index, depth);
            default:
                return object(index);
        }
    }

  private:
    void count(Index numbers) {
        count_ += numbers;
        if (count_ > kMostNumbers)
            throw InvalidArgument(fmt::format("an answer holds at most {} numbers or letters", kMostNumbers));
    }

    json text(int index) {
        std::size_t length = 0;
        const char* const text = lua_tolstring(L, index, &length);
        count(static_cast<Index>(length) + 1);
        return of_kind("text", {{"value", std::string(text, length)}});
    }

    /// The list part in its order, the named fields by name.
    json table(int index, int depth) {
        if (depth >= kDeepest)
            throw InvalidArgument(
                fmt::format("the table contains itself, or tables are nested more than {} deep", kDeepest));
        luaL_checkstack(L, 8, "nested tables");
        json items = json::array(), fields = json::object();
        const auto length = static_cast<lua_Integer>(lua_rawlen(L, index));
        for (lua_Integer i = 1; i <= length; ++i, lua_pop(L, 1)) {
            lua_rawgeti(L, index, i);
            items.push_back(value(lua_gettop(L), depth + 1));
        }
        for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
            count(1);
            const bool in_list = lua_isinteger(L, -2) && lua_tointeger(L, -2) >= 1 && lua_tointeger(L, -2) <= length;
            if (in_list) continue;
            if (lua_type(L, -2) != LUA_TSTRING)
                throw InvalidArgument("the keys of a table must be names, or count from 1 without gaps");
            const std::string name = lua_tostring(L, -2);
            count(static_cast<Index>(name.size()));
            fields[name] = value(lua_gettop(L), depth + 1);
        }
        return of_kind("table", {{"items", std::move(items)}, {"fields", std::move(fields)}});
    }

    json object(int index) {
        if (NumericBlock* const v = to_vector(L, index)) {
            count(v->rows);
            return of_kind("vector", json_of_matrix(v->matrix()));
        }
        if (NumericBlock* const m = to_matrix(L, index)) {
            count(m->rows * m->columns);
            return of_kind("matrix", json_of_matrix(m->matrix()));
        }
        if (const IdData* const data = to_object<IdData>(L, index)) {
            count(data->sample_count() * (data->input_count() + data->output_count() + 1));
            return of_kind("data", json_of_data(*data));
        }
        if (const Model* const model = to_object<Model>(L, index)) return of_kind("model", json_of_model(*model));
        if (const StateSpace* const system = to_object<StateSpace>(L, index))
            return of_kind("model", {{"state_space", json_of_system(*system)}});
        throw InvalidArgument(fmt::format("{} cannot be an answer; it can be a {}", given_text(L, index),
                                          fmt::join(answer_kinds(), ", ")));
    }

    lua_State* L;
    Index count_ = 0;
};

void push_value(lua_State* L, const json& j, int depth);

void push_table(lua_State* L, const json& j, int depth) {
    if (depth >= kDeepest) throw InvalidArgument("the answer's tables are nested too deep");
    luaL_checkstack(L, 8, "nested tables");
    lua_newtable(L);
    lua_Integer i = 0;
    for (const json& item : j.at("items")) {
        push_value(L, item, depth + 1);
        lua_rawseti(L, -2, ++i);
    }
    for (const auto& [name, value] : j.at("fields").items()) {
        lua_pushlstring(L, name.data(), name.size());
        push_value(L, value, depth + 1);
        lua_rawset(L, -3);
    }
}

void push_value(lua_State* L, const json& j, int depth) {
    const Call call(L);
    const std::string kind = j.at("kind");
    if (kind == "number") {
        lua_pushnumber(L, number_of_json(j.at("value")));
    } else if (kind == "truth") {
        lua_pushboolean(L, j.at("value").get<bool>());
    } else if (kind == "text") {
        call.give(j.at("value").get<std::string>());
    } else if (kind == "vector") {
        call.give_vector(Vector(matrix_of_json(j).reshaped()));
    } else if (kind == "matrix") {
        call.give_matrix(matrix_of_json(j));
    } else if (kind == "data") {
        push_object(L, data_of_json(j));
    } else if (kind == "model" && j.contains("state_space")) {
        push_object(L, system_of_json(j.at("state_space")));
    } else if (kind == "model") {
        push_object(L, model_of_json(j));
    } else if (kind == "table") {
        push_table(L, j, depth);
    } else {
        throw InvalidArgument("the answer is of an unknown kind");
    }
}

}  // namespace

AnswerValue answer_value(lua_State* L, int index) {
    const json j = Writer(L).value(lua_absindex(L, index), 0);
    return {j.at("kind"), j.dump(-1, ' ', false, json::error_handler_t::replace)};
}

void push_answer_value(lua_State* L, const std::string& text) {
    try {
        push_value(L, json::parse(text), 0);
    } catch (const json::exception&) {
        throw InvalidArgument("the answer is damaged");
    }
}

}  // namespace dynlab::inline scripting
