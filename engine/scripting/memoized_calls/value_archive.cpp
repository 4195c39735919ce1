#include "scripting/memoized_calls/value_archive.h"

#include <algorithm>
#include <array>

#include "scripting/arguments/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/numeric.h"
#include "scripting/objects/study_objects.h"

namespace dynlab::inline scripting {
namespace {

enum class ValueKind : std::uint8_t { kNil, kTruth, kNumber, kWhole, kText, kTable, kVector, kMatrix, kObject };

constexpr int kDeepestTable = 20;

/// How objects of one type are written and pushed.
struct ObjectCodec {
    const ObjectType* type;
    void (*put)(lua_State* L, int index, ArchiveWriter& archive);
    void (*push)(const Call& call, ArchiveReader& archive);
};

template <class T>
ObjectCodec codec_of() {
    return {&Boxed<T>::type,
            [](lua_State* L, int index, ArchiveWriter& archive) { archive.put(*to_object<T>(L, index)); },
            [](const Call& call, ArchiveReader& archive) { push_object(call.state(), archive.get<T>()); }};
}

ObjectCodec codec_of_figures() {
    return {&Boxed<FigurePointer>::type,
            [](lua_State* L, int index, ArchiveWriter& archive) {
                archive.put((*to_object<FigurePointer>(L, index))->figure);
            },
            [](const Call& call, ArchiveReader& archive) { give_figure(call, archive.get<Figure>()); }};
}

const auto& object_codecs() {
    static const std::array codecs = {codec_of<IdData>(),        codec_of<Model>(),      codec_of<StateSpace>(),
                                      codec_of<Complex>(),       codec_of<MonteCarlo>(), codec_of<OrderTable>(),
                                      codec_of<ComplexVector>(), codec_of_figures()};
    return codecs;
}

bool put_object(lua_State* L, int index, ArchiveWriter& archive) {
    for (const auto& [block, kind] :
         {std::pair(to_vector(L, index), ValueKind::kVector), std::pair(to_matrix(L, index), ValueKind::kMatrix)}) {
        if (block == nullptr) continue;
        archive.put(kind);
        archive.put(Matrix(block->matrix()));
        return true;
    }
    const auto& codecs = object_codecs();
    const auto codec = std::find_if(codecs.begin(), codecs.end(),
                                    [type = object_type(L, index)](const auto& known) { return known.type == type; });
    if (codec == codecs.end()) return false;
    archive.put(ValueKind::kObject);
    archive.put(static_cast<std::uint64_t>(codec - codecs.begin()));
    codec->put(L, index, archive);
    return true;
}

bool has_metatable(lua_State* L, int index) {
    if (!lua_getmetatable(L, index)) return false;
    lua_pop(L, 1);
    return true;
}

bool put_at_depth(lua_State* L, int index, ArchiveWriter& archive, int depth);

/// The entries ordered by what their keys are written as: Lua's own order changes from run to run.
bool put_table(lua_State* L, int index, ArchiveWriter& archive, int depth) {
    const auto data_name = name_of_refusing_table(L, index);
    if (depth > kDeepestTable || (!data_name && has_metatable(L, index))) return false;
    archive.put(ValueKind::kTable);
    archive.put(data_name);
    std::vector<std::pair<std::string, std::string>> entries;
    lua_pushnil(L);
    while (lua_next(L, index)) {
        ArchiveWriter key, value;
        const bool known =
            put_at_depth(L, lua_gettop(L) - 1, key, depth) && put_at_depth(L, lua_gettop(L), value, depth);
        lua_pop(L, 1);
        if (!known) {
            lua_pop(L, 1);
            return false;
        }
        entries.emplace_back(key.bytes(), value.bytes());
    }
    std::sort(entries.begin(), entries.end());
    archive.put(entries);
    return true;
}

bool put_at_depth(lua_State* L, int index, ArchiveWriter& archive, int depth) {
    luaL_checkstack(L, 8, "too many nested tables");
    switch (lua_type(L, index)) {
        case LUA_TNIL:
            archive.put(ValueKind::kNil);
            return true;
        case LUA_TBOOLEAN:
            archive.put(ValueKind::kTruth);
            archive.put(lua_toboolean(L, index) != 0);
            return true;
        case LUA_TNUMBER:
            archive.put(lua_isinteger(L, index) ? ValueKind::kWhole : ValueKind::kNumber);
            if (lua_isinteger(L, index))
                archive.put(lua_tointeger(L, index));
            else
                archive.put(lua_tonumber(L, index));
            return true;
        case LUA_TSTRING: {
            std::size_t length = 0;
            const char* text = lua_tolstring(L, index, &length);
            archive.put(ValueKind::kText);
            archive.put(std::string(text, length));
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

void push_table(const Call& call, ArchiveReader& archive) {
    lua_State* L = call.state();
    const auto data_name = archive.get<std::optional<std::string>>();
    const auto entries = archive.get<std::vector<std::pair<std::string, std::string>>>();
    lua_createtable(L, 0, static_cast<int>(entries.size()));
    for (const auto& [key, value] : entries) {
        ArchiveReader of_key(key), of_value(value);
        push_archived_value(call, of_key);
        push_archived_value(call, of_value);
        lua_rawset(L, -3);
    }
    if (data_name) refuse_unknown_fields(L, *data_name);
}

}  // namespace

bool put_value(lua_State* L, int index, ArchiveWriter& archive) {
    return put_at_depth(L, lua_absindex(L, index), archive, 0);
}

void push_archived_value(const Call& call, ArchiveReader& archive) {
    lua_State* L = call.state();
    luaL_checkstack(L, 8, "too many nested tables");
    switch (archive.get<ValueKind>()) {
        case ValueKind::kNil:
            return lua_pushnil(L);
        case ValueKind::kTruth:
            return lua_pushboolean(L, archive.get<bool>());
        case ValueKind::kNumber:
            return lua_pushnumber(L, archive.get<lua_Number>());
        case ValueKind::kWhole:
            return lua_pushinteger(L, archive.get<lua_Integer>());
        case ValueKind::kText:
            call.give(archive.get<std::string>());
            return;
        case ValueKind::kTable:
            return push_table(call, archive);
        case ValueKind::kVector:
            call.give_vector(archive.get<Matrix>().reshaped());
            return;
        case ValueKind::kMatrix:
            call.give_matrix(archive.get<Matrix>());
            return;
        case ValueKind::kObject:
            return object_codecs().at(archive.get<std::uint64_t>()).push(call, archive);
    }
    throw std::out_of_range("an archive holds an unknown kind of value");
}

}  // namespace dynlab::inline scripting
