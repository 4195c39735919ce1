#include "scripting/arguments/order_vector.h"

#include <cmath>

#include "numerics/number_text.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kLargestOrder = 1e6;

std::string meaning_of(std::span<const OrderEntry> entries) {
    std::vector<std::string> names, meanings;
    for (const OrderEntry& entry : entries) {
        names.emplace_back(entry.name);
        meanings.push_back(fmt::format("{}: {}", entry.name, entry.meaning));
    }
    return fmt::format("{{{}}} ({})", fmt::join(names, ", "), fmt::join(meanings, "; "));
}

int checked_order(double value, int index, std::span<const OrderEntry> entries, const char* name) {
    if (std::floor(value) != value || value < 0 || value > kLargestOrder)
        refuse_orders(index, entries, fmt::format("{} is {:.10g}, and must be a whole number from 0 on", name, value));
    return static_cast<int>(value);
}

/// The number, table or vector on top of the stack as a list.
std::vector<int> entry_list(lua_State* L, int index, std::span<const OrderEntry> entries, const char* name) {
    if (lua_type(L, -1) == LUA_TNUMBER) return {checked_order(lua_tonumber(L, -1), index, entries, name)};
    std::vector<int> list;
    if (NumericBlock* vector = to_vector(L, -1)) {
        for (const double value : vector->vector()) list.push_back(checked_order(value, index, entries, name));
        return list;
    }
    if (lua_type(L, -1) != LUA_TTABLE)
        refuse_orders(index, entries, fmt::format("{} is {}", name, given_text(L, lua_gettop(L))));
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, -1));
    if (count == 0) refuse_orders(index, entries, fmt::format("{} is an empty table", name));
    for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(L, -1, i);
        if (lua_type(L, -1) != LUA_TNUMBER)
            refuse_orders(index, entries, fmt::format("{} holds {}", name, given_text(L, lua_gettop(L))));
        list.push_back(checked_order(lua_tonumber(L, -1), index, entries, name));
        lua_pop(L, 1);
    }
    return list;
}

}  // namespace

std::vector<std::vector<int>> order_lists(const Call& call, int index, std::span<const OrderEntry> entries) {
    lua_State* L = call.state();
    const auto wrong_count = [&](Index count) {
        const bool many = count > static_cast<Index>(entries.size()) + 1;
        refuse_orders(
            index, entries,
            fmt::format("it has {}{}", counted(count, "entry", "entries"),
                        many ? "; with several inputs an entry is a list of one value for each, such as {1, 1}" : ""));
    };
    std::vector<std::vector<int>> lists;
    if (index <= call.count()) {
        if (NumericBlock* vector = to_vector(L, index)) {
            const auto values = vector->vector();
            if (values.size() != static_cast<Index>(entries.size())) wrong_count(values.size());
            for (Index i = 0; i < values.size(); ++i)
                lists.push_back({checked_order(values[i], index, entries, entries[static_cast<std::size_t>(i)].name)});
            return lists;
        }
        if (call.type(index) == LUA_TTABLE) {
            const auto count = static_cast<std::size_t>(lua_rawlen(L, index));
            if (count != entries.size()) wrong_count(static_cast<Index>(count));
            for (std::size_t i = 0; i < count; ++i) {
                lua_rawgeti(L, index, static_cast<lua_Integer>(i + 1));
                lists.push_back(entry_list(L, index, entries, entries[i].name));
                lua_pop(L, 1);
            }
            return lists;
        }
    }
    refuse_orders(index, entries, call.given(index) ? given_text(L, index) + " was given" : "it is missing");
}

void refuse_orders(int index, std::span<const OrderEntry> entries, const std::string& wrong) {
    throw InvalidArgument(fmt::format("argument {} (orders) must be {}, but {}", index, meaning_of(entries), wrong));
}

}  // namespace dynlab::inline scripting
