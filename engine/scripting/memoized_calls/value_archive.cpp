#include "scripting/memoized_calls/value_archive.h"

#include <algorithm>
#include <array>

#include "documents/figure_description.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model_description.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kDeepestTable = 20;

/// How objects of one type are written and pushed. Their name is written before them.
struct ObjectCodec {
    const ObjectType* type;
    void (*put)(lua_State* L, int index, CborWriter& archive);
    void (*push)(const Call& call, CborReader& archive, std::vector<FigurePointer>& figures);
};

template <class T>
ObjectCodec codec_of() {
    return {&Userdata<T>::type,
            [](lua_State* L, int index, CborWriter& archive) { write_value(archive, *to_object<T>(L, index)); },
            [](const Call& call, CborReader& archive, std::vector<FigurePointer>&) {
                push_object(call.state(), read_fresh<T>(archive));
            }};
}

ObjectCodec codec_of_figures() {
    return {&Userdata<FigurePointer>::type,
            [](lua_State* L, int index, CborWriter& archive) {
                write_value(archive, (*to_object<FigurePointer>(L, index))->figure);
            },
            [](const Call& call, CborReader& archive, std::vector<FigurePointer>& figures) {
                auto figure = std::make_shared<ScriptFigure>(ScriptFigure{read_fresh<Figure>(archive), false, {}});
                push_object(call.state(), figure);
                figures.push_back(std::move(figure));
            }};
}

const auto& object_codecs() {
    static const std::array codecs = {codec_of<IdData>(),        codec_of<Model>(),         codec_of<StateSpace>(),
                                      codec_of<Complex>(),       codec_of<MonteCarlo>(),    codec_of<OrderTable>(),
                                      codec_of<ComplexVector>(), codec_of<FrequencyData>(), codec_of_figures()};
    return codecs;
}

bool put_object(lua_State* L, int index, CborWriter& archive) {
    for (const auto& [block, form] :
         {std::pair(to_vector(L, index), ArrayForm::kVector), std::pair(to_matrix(L, index), ArrayForm::kMatrix)}) {
        if (block == nullptr) continue;
        archive.array({form, block->rows, block->columns, block->data()});
        return true;
    }
    const auto& codecs = object_codecs();
    const auto codec = std::find_if(codecs.begin(), codecs.end(),
                                    [type = object_type(L, index)](const auto& known) { return known.type == type; });
    if (codec == codecs.end()) return false;
    archive.begin_object();
    archive.member(codec->type->name);
    codec->put(L, index, archive);
    archive.end_object();
    return true;
}

bool has_metatable(lua_State* L, int index) {
    if (!lua_getmetatable(L, index)) return false;
    lua_pop(L, 1);
    return true;
}

bool put_at_depth(lua_State* L, int index, CborWriter& archive, int depth);

/// The entries ordered by what their keys are written as: Lua's own order changes from run to run. A list of the data's
/// name, where it has one, then each key and its value.
bool put_table(lua_State* L, int index, CborWriter& archive, int depth) {
    const auto data_name = name_of_refusing_table(L, index);
    if (depth > kDeepestTable || (!data_name && has_metatable(L, index))) return false;
    std::vector<std::pair<std::string, std::string>> entries;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        CborWriter key, value;
        const bool known =
            put_at_depth(L, lua_gettop(L) - 1, key, depth) && put_at_depth(L, lua_gettop(L), value, depth);
        lua_pop(L, 1);
        if (!known) {
            lua_pop(L, 1);
            return false;
        }
        entries.emplace_back(key.take(), value.take());
    }
    std::sort(entries.begin(), entries.end());
    archive.begin_list(1 + 2 * entries.size());
    write_value(archive, data_name);
    for (const auto& [key, value] : entries) {
        archive.encoded(key);
        archive.encoded(value);
    }
    return true;
}

bool put_at_depth(lua_State* L, int index, CborWriter& archive, int depth) {
    luaL_checkstack(L, 8, "too many nested tables");
    switch (lua_type(L, index)) {
        case LUA_TNIL:
            archive.nothing();
            return true;
        case LUA_TBOOLEAN:
            archive.truth(lua_toboolean(L, index) != 0);
            return true;
        case LUA_TNUMBER:
            if (lua_isinteger(L, index))
                archive.whole(lua_tointeger(L, index));
            else
                archive.number(lua_tonumber(L, index));
            return true;
        case LUA_TSTRING: {
            std::size_t length = 0;
            const char* text = lua_tolstring(L, index, &length);
            archive.text({text, length});
            return true;
        }
        case LUA_TTABLE:
            return put_table(L, index, archive, depth + 1);
        case LUA_TUSERDATA:
            return put_object(L, index, archive);
        default:
            return false;
    }
}

void push_table(const Call& call, CborReader& archive, std::vector<FigurePointer>& figures) {
    lua_State* L = call.state();
    const std::size_t count = archive.begin_list(2 * sizeof(lua_Number));
    if (count % 2 == 0) archive.refuse(Message("a table consists of a name and pairs of a key and a value"));
    archive.element();
    const auto data_name = read_fresh<std::optional<std::string>>(archive);
    lua_createtable(L, 0, static_cast<int>(count / 2));
    for (std::size_t i = 0; i < count / 2; ++i) {
        archive.element();
        push_archived_value(call, archive, figures);
        const bool usable = !lua_isnil(L, -1) && !(lua_isnumber(L, -1) && lua_tonumber(L, -1) != lua_tonumber(L, -1));
        if (!usable) archive.refuse(Message("the value cannot be a key of a table"));
        archive.element();
        push_archived_value(call, archive, figures);
        lua_rawset(L, -3);
    }
    archive.end_list();
    if (data_name) refuse_unknown_fields(L, *data_name);
}

void push_array(const Call& call, CborReader& archive) {
    const NumberArray numbers = archive.array({});
    if (numbers.is_complex()) archive.refuse(Message("complex numbers must be in an object"));
    Matrix values(numbers.rows, numbers.columns);
    if (numbers.bytes() > 0) std::memcpy(values.data(), numbers.numbers, numbers.bytes());
    if (numbers.form == ArrayForm::kVector)
        call.give_vector(values.reshaped());
    else
        call.give_matrix(values);
}

void push_known_object(const Call& call, CborReader& archive, std::vector<FigurePointer>& figures) {
    archive.begin_object();
    for (const ObjectCodec& codec : object_codecs()) {
        if (!archive.member(codec.type->name)) continue;
        codec.push(call, archive, figures);
        return archive.end_object();
    }
    archive.refuse(Message("the object has an unknown type"));
}

}  // namespace

bool put_value(lua_State* L, int index, CborWriter& archive) {
    return put_at_depth(L, lua_absindex(L, index), archive, 0);
}

void push_archived_value(const Call& call, CborReader& archive, std::vector<FigurePointer>& figures) {
    using Kind = CborReader::Kind;
    lua_State* L = call.state();
    luaL_checkstack(L, 8, "too many nested tables");
    switch (archive.next()) {
        case Kind::kNothing:
            archive.nothing();
            return lua_pushnil(L);
        case Kind::kTruth:
            return lua_pushboolean(L, archive.truth());
        case Kind::kNumber:
            return lua_pushnumber(L, archive.number());
        case Kind::kWhole:
            return lua_pushinteger(L, archive.whole(LUA_MININTEGER, LUA_MAXINTEGER));
        case Kind::kText:
            call.give(archive.text());
            return;
        case Kind::kList:
            return push_table(call, archive, figures);
        case Kind::kArray:
            return push_array(call, archive);
        case Kind::kObject:
            return push_known_object(call, archive, figures);
        default:
            archive.refuse(Message("the value has an unknown kind"));
    }
}

}  // namespace dynlab::inline scripting
