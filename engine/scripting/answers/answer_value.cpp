#include "scripting/answers/answer_value.h"

#include "base/error.h"
#include "data_io/values/json_values.h"
#include "documents/percent_script.h"
#include "platform/spelling.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model_description.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMaxDepth = 8;
constexpr Index kMaxNumbers = 500'000;

/// Of an answer, which may come from anybody: most it can take in memory, a model's highest order.
ValueLimits answer_limits() {
    ValueLimits limits;
    limits.bytes = 64u << 20;
    limits.memory = 512u << 20;
    limits.depth = 100;
    limits.coefficients = 101;
    return limits;
}

/// Makes the JSON of one value; what it holds is counted, as tables may share others. Each value is an object with its
/// kind and, beside it, its members.
class AnswerWriter {
  public:
    explicit AnswerWriter(lua_State* state) : L(state) {}

    /// Returns the kind.
    std::string value(int index, int depth) {
        json_.begin_object();
        const char* const kind = members(index, depth);
        json_.member("kind");
        json_.text(kind);
        json_.end_object();
        return kind;
    }

    std::string text() const { return json_.dump(-1); }

  private:
    const char* members(int index, int depth) {
        switch (lua_type(L, index)) {
            case LUA_TNUMBER:
                count(1);
                json_.member("value");
                json_.number(lua_tonumber(L, index));
                return "number";
            case LUA_TBOOLEAN:
                count(1);
                json_.member("value");
                json_.truth(lua_toboolean(L, index) != 0);
                return "truth";
            case LUA_TSTRING:
                text_members(index);
                return "text";
            case LUA_TTABLE:
                table_members(index, depth);
                return "table";
            default:
                return object_members(index);
        }
    }

    void count(Index numbers) {
        count_ += numbers;
        if (count_ > kMaxNumbers)
            throw InvalidArgument("an answer can have at most {} numbers or characters; submit fewer values",
                                  kMaxNumbers);
    }

    void text_members(int index) {
        std::size_t length = 0;
        const char* const text = lua_tolstring(L, index, &length);
        count(static_cast<Index>(length) + 1);
        json_.member("value");
        json_.text({text, length});
    }

    /// The list part in its order, the named fields by name.
    void table_members(int index, int depth) {
        if (depth >= kMaxDepth)
            throw InvalidArgument("the table contains itself, or its tables are nested deeper than {} levels",
                                  kMaxDepth);
        luaL_checkstack(L, 8, "nested tables");
        const auto length = static_cast<lua_Integer>(lua_rawlen(L, index));
        json_.member("items");
        json_.begin_list(0);
        for (lua_Integer i = 1; i <= length; ++i, lua_pop(L, 1)) {
            lua_rawgeti(L, index, i);
            value(lua_gettop(L), depth + 1);
        }
        json_.end_list();
        json_.member("fields");
        json_.begin_map(0);
        for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
            count(1);
            const bool in_list = lua_isinteger(L, -2) && lua_tointeger(L, -2) >= 1 && lua_tointeger(L, -2) <= length;
            if (in_list) continue;
            if (lua_type(L, -2) != LUA_TSTRING)
                throw InvalidArgument(
                    "the keys of a table in an answer must be names, or the integers from 1 without gaps");
            const std::string name = lua_tostring(L, -2);
            count(static_cast<Index>(name.size()));
            json_.key(name);
            value(lua_gettop(L), depth + 1);
        }
        json_.end_map();
    }

    void numbers(NumericBlock& block) {
        count(block.rows * block.columns);
        json_.member("rows");
        json_.whole(block.rows);
        json_.member("columns");
        json_.whole(block.columns);
        json_.member("values");
        json_.array({ArrayForm::kVector, block.rows * block.columns, 1, block.data()});
    }

    const char* object_members(int index) {
        if (NumericBlock* const v = to_vector(L, index)) return numbers(*v), "vector";
        if (NumericBlock* const m = to_matrix(L, index)) return numbers(*m), "matrix";
        if (const IdData* const data = to_object<IdData>(L, index)) {
            count(data->sample_count() * (data->input_count() + data->output_count() + 1));
            write_members(json_, *data);
            return "data";
        }
        if (const Model* const model = to_object<Model>(L, index)) return write_members(json_, *model), "model";
        if (const FrequencyData* const response = to_object<FrequencyData>(L, index)) {
            count(8 * response->w.size());
            return write_members(json_, *response), "response";
        }
        if (const StateSpace* const system = to_object<StateSpace>(L, index)) {
            json_.member("state_space");
            write_value(json_, *system);
            return "model";
        }
        throw InvalidArgument("{} cannot be an answer; the kinds of answers are {}", given_value(L, index),
                              listed(answer_kinds()));
    }

    lua_State* L;
    JsonWriter json_;
    Index count_ = 0;
};

void need_member(ValueReader& answer, const char* name) {
    if (!answer.member(name)) answer.lacks(name);
}

template <class T>
T member_of(ValueReader& answer, const char* name) {
    need_member(answer, name);
    return read_fresh<T>(answer);
}

/// The members of an object that is open already.
template <class T>
T members_as(ValueReader& answer) {
    T value = blank<T>();
    read_members(answer, value);
    return value;
}

Matrix matrix_members(ValueReader& answer) {
    const auto rows = member_of<Index>(answer, "rows"), columns = member_of<Index>(answer, "columns");
    const Vector values = member_of<Vector>(answer, "values");
    if (rows < 0 || columns < 0 || (rows > 0 && columns > values.size() / rows) || rows * columns != values.size())
        answer.refuse(Message("the number of values is not rows x columns"));
    return values.reshaped(rows, columns);
}

void push_answer(lua_State* L, ValueReader& answer, int depth);

void push_answer_table(lua_State* L, ValueReader& answer, int depth) {
    if (depth >= kMaxDepth) throw InvalidArgument("the answer's tables are nested too deeply");
    luaL_checkstack(L, 8, "nested tables");
    lua_newtable(L);
    need_member(answer, "items");
    const std::size_t items = answer.begin_list(sizeof(lua_Number));
    for (std::size_t i = 1; i <= items; ++i) {
        answer.element();
        push_answer(L, answer, depth + 1);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i));
    }
    answer.end_list();
    need_member(answer, "fields");
    for (std::size_t left = answer.begin_map(sizeof(lua_Number)); left > 0; --left) {
        const std::string name = answer.key();
        lua_pushlstring(L, name.data(), name.size());
        push_answer(L, answer, depth + 1);
        lua_rawset(L, -3);
    }
    answer.end_map();
}

void push_members(lua_State* L, const std::string& kind, ValueReader& answer, int depth) {
    const Call call(L);
    if (kind == "number") {
        lua_pushnumber(L, member_of<double>(answer, "value"));
    } else if (kind == "truth") {
        lua_pushboolean(L, member_of<bool>(answer, "value"));
    } else if (kind == "text") {
        call.give(member_of<std::string>(answer, "value"));
    } else if (kind == "vector") {
        call.give_vector(Vector(matrix_members(answer).reshaped()));
    } else if (kind == "matrix") {
        call.give_matrix(matrix_members(answer));
    } else if (kind == "data") {
        push_object(L, members_as<IdData>(answer));
    } else if (kind == "response") {
        push_object(L, members_as<FrequencyData>(answer));
    } else if (kind == "model" && answer.member("state_space")) {
        push_object(L, read_fresh<StateSpace>(answer));
    } else if (kind == "model") {
        push_object(L, members_as<Model>(answer));
    } else if (kind == "table") {
        push_answer_table(L, answer, depth);
    } else {
        throw InvalidArgument("the answer has the unknown kind \"{}\"", kind);
    }
}

void push_answer(lua_State* L, ValueReader& answer, int depth) {
    answer.begin_object();
    push_members(L, member_of<std::string>(answer, "kind"), answer, depth);
    answer.end_object();
}

}  // namespace

AnswerValue answer_value(lua_State* L, int index) {
    AnswerWriter writer(L);
    std::string kind = writer.value(lua_absindex(L, index), 0);
    return {std::move(kind), writer.text()};
}

void push_answer_value(lua_State* L, const std::string& text) {
    try {
        const ValueLimits limits = answer_limits();
        JsonReader reader = JsonReader::of_text(text, limits);
        push_answer(L, reader, 0);
    } catch (const ValueError& error) {
        throw InvalidArgument("the answer is damaged: {}", message_of(error));
    }
}

Message undeclared_answer(const std::string& name, const std::vector<std::string>& names) {
    const auto near = nearest_word(name, names);
    return near ? Message("the script's header declares no answer \"{}\"; did you mean \"{}\"?", name, *near)
                : Message("the script's header declares no answer \"{}\"; the answers are {}", name, listed(names));
}

}  // namespace dynlab::inline scripting
