#include "scripting/conversions/numeric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/error.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

/// Throws InvalidArgument, naming size and limit, when `bytes` cannot be had for what() says.
template <class What>
void need_memory(lua_State* L, double bytes, const What& what) {
    MemoryAccount& memory = context_of(L).memory;
    const double limit = static_cast<double>(memory.limit());
    if (bytes <= limit && memory.fits(static_cast<std::size_t>(bytes))) return;
    if (bytes <= limit) lua_gc(L, LUA_GCCOLLECT);
    if (bytes > limit || !memory.fits(static_cast<std::size_t>(bytes)))
        throw InvalidArgument("{} needs {} of memory, but the limit of the script is {} and the script already uses {}",
                              what(), size_phrase(bytes), size_phrase(limit),
                              size_phrase(static_cast<double>(memory.used())));
}

template <class Block, class What>
Block& push_block(lua_State* L, double bytes, const What& what, const ObjectType& type, int user_values = 0) {
    need_memory(L, bytes + sizeof(Block), what);
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

/// The number of values in the entry on top of the stack: one, or a vector's size; -1 for anything else.
Index entry_size(lua_State* L) {
    if (lua_type(L, -1) == LUA_TNUMBER) return 1;
    const NumericBlock* block = to_vector(L, -1);
    return block == nullptr ? -1 : block->rows;
}

Index joined_size(lua_State* L, int index, Index entries, const Message& label) {
    Index total = 0;
    for (Index i = 1; i <= entries; ++i) {
        lua_rawgeti(L, index, i);
        const Index size = entry_size(L);
        if (size < 0)
            throw InvalidArgument("{} must be a vector of numbers, but its element {} is {}", label, i,
                                  given_value(L, -1));
        total += size;
        lua_pop(L, 1);
    }
    return total;
}

/// Throws for a table of named entries, such as the variables of a file; an empty table is an empty vector.
void refuse_named_entries(lua_State* L, int index, const Message& label) {
    std::vector<std::string> names;
    collect_text_keys(L, index, names);
    if (names.empty()) return;
    std::sort(names.begin(), names.end());
    throw InvalidArgument("{} must be a vector of numbers, but the table contains only named entries: {}", label,
                          listed(names));
}

/// Throws for a table without numbered entries: an empty one, or for example a table of named variables.
[[noreturn]] void refuse_without_entries(lua_State* L, int index, const Message& label) {
    std::vector<std::string> names;
    collect_text_keys(L, index, names);
    if (names.empty()) throw InvalidArgument("{} must have rows or columns, but the table is empty", label);
    std::sort(names.begin(), names.end());
    throw InvalidArgument(
        "{} must have rows or columns, but the table contains {}; use one of these entries, such as data.{}", label,
        listed(names), names.front());
}

/// Checks that the row or column `i` on top has the length of the first.
void check_length(Index length, Index first_length, Index i, bool row, const Message& label) {
    if (length == first_length) return;
    const Message values = plural(length, "{} value", "{} values");
    throw InvalidArgument(
        row ? Message("{}: row {} has {}, but row 1 has {}; all rows must have the same length", label, i, values,
                      first_length)
            : Message("{}: column {} has {}, but column 1 has {}; all columns must have the same length", label, i,
                      values, first_length));
}

}  // namespace

void charge_outside_bytes(lua_State* L, std::size_t bytes, const char* what) {
    need_memory(L, static_cast<double>(bytes), [what] { return Message::verbatim(what); });
    if (bytes >= 1024) lua_gc(L, LUA_GCSTEP, static_cast<int>(std::min<std::size_t>(bytes / 1024, 1 << 20)));
}

Message numbered_from_one(Index count) {
    return count == 0   ? Message("there are none")
           : count == 1 ? Message("the only valid number is 1")
                        : Message("the valid numbers are 1 to {}", count);
}

Message vector_shape(Index size) {
    return Message("a vector of {}", plural(size, "{} value", "{} values"));
}
Message matrix_shape(Index rows, Index columns) {
    return Message("a {} x {} matrix", rows, columns);
}

Index index_of_whole(double whole) {
    constexpr double kMax = static_cast<double>(std::numeric_limits<Index>::max() / 2);
    return static_cast<Index>(std::clamp(whole, -kMax, kMax));
}

NumericBlock& push_vector(lua_State* L, Index size) {
    auto& block = push_block<NumericBlock>(
        L, bytes_of(size, 1), [size] { return vector_shape(size); }, kVectorType);
    block = {size, 1};
    return block;
}

void require_memory_for_signal(lua_State* L, double count) {
    constexpr double kAtOnce = 3;
    if (count >= 1 && std::isfinite(count))  // else the calculation says what is wrong with it
        need_memory(L, kAtOnce * sizeof(double) * count,
                    [count] { return Message("a vector of {} values", decimals(count, 0)); });
}

void push_named_vector(lua_State* L, const Vector& values, const std::vector<std::string>& names) {
    auto& block = push_block<NumericBlock>(
        L, bytes_of(values.size(), 1), [] { return Message("a vector with names"); }, kVectorType, 1);
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
    auto& block = push_block<NumericBlock>(
        L, bytes_of(rows, columns), [=] { return matrix_shape(rows, columns); }, kMatrixType);
    block = {rows, columns};
    return block;
}

MaskBlock& push_mask(lua_State* L, Index size) {
    auto& block = push_block<MaskBlock>(
        L, static_cast<double>(size), [size] { return Message("a mask of {}", plural(size, "{} value", "{} values")); },
        kMaskType);
    block = {size};
    return block;
}

NumericBlock* to_vector(lua_State* L, int index) {
    return block_at<NumericBlock>(L, index, kVectorType);
}
NumericBlock* to_matrix(lua_State* L, int index) {
    return block_at<NumericBlock>(L, index, kMatrixType);
}
MaskBlock* to_mask(lua_State* L, int index) {
    return block_at<MaskBlock>(L, index, kMaskType);
}

void make_vector_of_table(lua_State* L, int index, const Message& label) {
    index = lua_absindex(L, index);
    const auto entries = static_cast<Index>(lua_rawlen(L, index));
    if (entries == 0) refuse_named_entries(L, index, label);
    const Index total = joined_size(L, index, entries, label);
    double* target = push_vector(L, total).data();
    for (Index i = 1; i <= entries; ++i) {
        if (lua_rawgeti(L, index, i) == LUA_TNUMBER) {
            *target++ = lua_tonumber(L, -1);
        } else {
            NumericBlock* part = to_vector(L, -1);
            target = std::copy_n(part->data(), part->rows, target);
        }
        lua_pop(L, 1);
    }
    lua_replace(L, index);
}

void make_matrix_of_table(lua_State* L, int index, const Message& label) {
    index = lua_absindex(L, index);
    const auto entries = static_cast<Index>(lua_rawlen(L, index));
    if (entries == 0) refuse_without_entries(L, index, label);
    const bool by_rows = lua_rawgeti(L, index, 1) == LUA_TTABLE;
    const Index length =
        by_rows ? joined_size(L, lua_gettop(L), static_cast<Index>(lua_rawlen(L, -1)), Message("{}, row {}", label, 1))
                : entry_size(L);
    if (length < 0 || lua_isnumber(L, -1))
        throw InvalidArgument(
            "{} must be a list of rows {{1, 2}, {3, 4}} or of vectors (its columns), but entry 1 is {}", label,
            given_value(L, -1));
    lua_pop(L, 1);
    NumericBlock& block = by_rows ? push_matrix(L, entries, length) : push_matrix(L, length, entries);
    for (Index i = 0; i < entries; ++i) {
        const Message entry = by_rows ? Message("{}, row {}", label, i + 1) : Message("{}, column {}", label, i + 1);
        if ((lua_rawgeti(L, index, i + 1) == LUA_TTABLE) != by_rows || (!by_rows && to_vector(L, -1) == nullptr)) {
            const Message given = given_value(L, -1);
            throw InvalidArgument(by_rows
                                      ? Message("{} must be a table of numbers like row 1, but it is {}", entry, given)
                                      : Message("{} must be a vector like column 1, but it is {}", entry, given));
        }
        if (by_rows) make_vector_of_table(L, -1, entry);
        NumericBlock* part = to_vector(L, -1);
        check_length(part->rows, length, i + 1, by_rows, label);
        if (by_rows) {
            block.matrix().row(i) = part->vector().transpose();
        } else {
            block.matrix().col(i) = part->vector();
        }
        lua_pop(L, 1);
    }
    lua_replace(L, index);
}

}  // namespace dynlab::inline scripting
