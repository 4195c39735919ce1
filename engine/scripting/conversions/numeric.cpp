#include "scripting/conversions/numeric.h"

#include <fmt/format.h>

#include "numerics/error.h"
#include "scripting/conversions/boxed.h"
#include "scripting/conversions/named_vector.h"
#include "scripting/conversions/numeric_types.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {
namespace {

std::string size_text(double bytes) {
    return bytes >= 1e9 ? fmt::format("{:.3g} GB", bytes / 1e9) : fmt::format("{:.3g} MB", bytes / 1e6);
}

/// Throws InvalidArgument, naming size and limit, when `bytes` cannot be had.
void need_memory(lua_State* L, double bytes, const char* what) {
    MemoryAccount& memory = context_of(L).memory;
    const double limit = static_cast<double>(memory.limit());
    if (bytes <= limit && memory.fits(static_cast<std::size_t>(bytes))) return;
    if (bytes <= limit) lua_gc(L, LUA_GCCOLLECT);
    if (bytes > limit || !memory.fits(static_cast<std::size_t>(bytes)))
        throw InvalidArgument(fmt::format("{} needs {}, but the script may use {} in all and holds {} already", what,
                                          size_text(bytes), size_text(limit),
                                          size_text(static_cast<double>(memory.used()))));
}

template <class Block>
Block& push_block(lua_State* L, double bytes, const std::string& what, const ObjectType& type, int user_values = 0) {
    need_memory(L, bytes + sizeof(Block), what.c_str());
    auto* block =
        static_cast<Block*>(lua_newuserdatauv(L, sizeof(Block) + static_cast<std::size_t>(bytes), user_values));
    push_metatable(L, type);
    lua_setmetatable(L, -2);
    return *block;
}

template <class Block>
Block* block_at(lua_State* L, int index, const ObjectType& type) {
    return is_object(L, index, type) ? static_cast<Block*>(lua_touserdata(L, index)) : nullptr;
}

double bytes_of(Index rows, Index columns) {
    return 8.0 * static_cast<double>(rows) * static_cast<double>(columns) + NumericBlock::kAlignment;
}

}  // namespace

void charge_outside_bytes(lua_State* L, std::size_t bytes, const char* what) {
    need_memory(L, static_cast<double>(bytes), what);
    if (bytes >= 1024) lua_gc(L, LUA_GCSTEP, static_cast<int>(std::min<std::size_t>(bytes / 1024, 1 << 20)));
}

NumericBlock& push_vector(lua_State* L, Index size) {
    auto& block =
        push_block<NumericBlock>(L, bytes_of(size, 1), fmt::format("a vector of {} values", size), vector_type());
    block = {size, 1};
    return block;
}

void push_named_vector(lua_State* L, const Vector& values, const std::vector<std::string>& names) {
    auto& block = push_block<NumericBlock>(L, bytes_of(values.size(), 1), "a vector with names", vector_type(), 1);
    block = {values.size(), 1};
    block.vector() = values;
    lua_createtable(L, 0, static_cast<int>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
        lua_pushnumber(L, values[static_cast<Index>(i)]);
        lua_setfield(L, -2, names[i].c_str());
    }
    lua_setiuservalue(L, -2, 1);
}

NumericBlock& push_matrix(lua_State* L, Index rows, Index columns) {
    auto& block = push_block<NumericBlock>(L, bytes_of(rows, columns), fmt::format("a {} x {} matrix", rows, columns),
                                           matrix_type());
    block = {rows, columns};
    return block;
}

MaskBlock& push_mask(lua_State* L, Index size) {
    auto& block =
        push_block<MaskBlock>(L, static_cast<double>(size), fmt::format("a mask of {} values", size), mask_type());
    block = {size};
    return block;
}

NumericBlock* to_vector(lua_State* L, int index) {
    return block_at<NumericBlock>(L, index, vector_type());
}
NumericBlock* to_matrix(lua_State* L, int index) {
    return block_at<NumericBlock>(L, index, matrix_type());
}
MaskBlock* to_mask(lua_State* L, int index) {
    return block_at<MaskBlock>(L, index, mask_type());
}

}  // namespace dynlab::inline scripting
