#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/numeric_operators.h"
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

Message elements_of(Index size) {
    return size == 0   ? Message("no elements")
           : size == 1 ? Message("only the element 1")
                       : Message("the elements 1 to {}", size);
}

[[noreturn]] void refuse_element(const char* what, double number, Index size) {
    const Number place = significant(number, 10);
    if (number == 0 && size > 0)
        throw InvalidArgument("{}[{}] does not exist: {} has {}; the first element is {}[1]", what, place, what,
                              elements_of(size), what);
    if (number >= 0) throw InvalidArgument("{}[{}] does not exist: {} has {}", what, place, what, elements_of(size));
    throw InvalidArgument("{}[{}] does not exist: {} has {}; the last element is {}[#{}]", what, place, what,
                          elements_of(size), what, what);
}

/// Reads an element number from 1 to `size`, 0-based. `what` is "v" or "row" for messages.
Index element_index(lua_State* L, int index, Index size, const char* what) {
    if (lua_isinteger(L, index)) {
        const lua_Integer number = lua_tointeger(L, index);
        if (number >= 1 && number <= size) return number - 1;
        refuse_element(what, static_cast<double>(number), size);
    }
    if (lua_type(L, index) != LUA_TNUMBER)
        throw InvalidArgument(to_mask(L, index) != nullptr
                                  ? Message("{}[i] needs a whole number i from 1 to {}, but {} was given; write "
                                            "v:select(mask), or loop over find(mask) to set elements",
                                            what, size, given_value(L, index))
                                  : Message("{}[i] needs a whole number i from 1 to {}, but {} was given", what, size,
                                            given_value(L, index)));
    const double number = lua_tonumber(L, index);
    if (std::floor(number) != number)
        throw InvalidArgument("{}[{}]: the index of an element must be a whole number from 1 to {}", what,
                              significant(number, 10), size);
    if (number >= 1 && number <= static_cast<double>(size)) return static_cast<Index>(number) - 1;
    refuse_element(what, number, size);
}

int read_element(Call& call) {
    NumericBlock* v = to_vector(call.state(), 1);
    return call.give(v->data()[element_index(call.state(), 2, v->rows, "v")]);
}

int write_element(Call& call) {
    NumericBlock* v = to_vector(call.state(), 1);
    if (lua_isinteger(call.state(), 2) && lua_tointeger(call.state(), 2) > v->rows)
        throw InvalidArgument(
            "v[{}] does not exist: v has {}, and its length is fixed. Use zeros(n) to create a vector of length n, or "
            "vector{v, x} to append x to v",
            lua_tointeger(call.state(), 2), plural(v->rows, "{} element", "{} elements"));
    const Index number = element_index(call.state(), 2, v->rows, "v");
    v->data()[number] = call.number(3, Message("the new value"));
    return 0;
}

NumericBlock& vector_self(Call& call) {
    NumericBlock* v = to_vector(call.state(), 1);
    if (v == nullptr)
        wrong_argument(call.state(), 1, "v", Message("a vector; methods are called with a colon, v:name(...)"));
    return *v;
}

int vector_length(Call& call) {
    return call.give_integer(vector_self(call).rows);
}
int vector_tostring(Call& call) {
    return call.give(vector_text(vector_self(call).vector(), reader_of(call)));
}

int vector_range(Call& call) {
    call.at_most(3);
    NumericBlock& v = vector_self(call);
    const Index first = call.integer(2, "first"), last = call.integer(3, "last");
    if (first < 1 || last > v.rows || first > last + 1)
        throw InvalidArgument("elements {} to {} cannot be selected: v has {}", first, last, elements_of(v.rows));
    return call.give_vector(v.vector().segment(first - 1, last - first + 1));
}

int select_by_mask(Call& call, NumericBlock& v, MaskBlock& mask) {
    if (mask.size != v.rows)
        throw InvalidArgument(
            "the mask and the vector must have the same number of elements, but the mask has {} and the vector has {}",
            plural(mask.size, "{} value", "{} values"), v.rows);
    const Index count = std::count(mask.data(), mask.data() + mask.size, true);
    double* target = push_vector(call.state(), count).data();
    for (Index i = 0; i < v.rows; ++i)
        if (mask.data()[i]) *target++ = v.data()[i];
    return 1;
}

int vector_select(Call& call) {
    call.at_most(2);
    NumericBlock& v = vector_self(call);
    if (MaskBlock* mask = to_mask(call.state(), 2)) return select_by_mask(call, v, *mask);
    const VectorMap numbers = call.vector(2, Message("mask or element numbers"));
    NumericBlock& result = push_vector(call.state(), numbers.size());
    for (Index i = 0; i < numbers.size(); ++i) {
        const double number = numbers[i];
        if (std::floor(number) != number || number < 1 || number > static_cast<double>(v.rows))
            throw InvalidArgument("the element {} does not exist: v has {}", significant(number, 10),
                                  elements_of(v.rows));
        result.data()[i] = v.data()[static_cast<Index>(number) - 1];
    }
    return 1;
}

int vector_table(Call& call) {
    NumericBlock& v = vector_self(call);
    lua_createtable(call.state(), static_cast<int>(v.rows), 0);
    for (Index i = 0; i < v.rows; ++i) {
        lua_pushnumber(call.state(), v.data()[i]);
        lua_rawseti(call.state(), -2, i + 1);
    }
    return 1;
}

/// v.k1 of a vector whose values have names; nil of others.
int vector_named(Call& call) {
    lua_State* L = call.state();
    if (lua_type(L, 2) != LUA_TSTRING || lua_getiuservalue(L, 1, 1) != LUA_TTABLE) return lua_pushnil(L), 1;
    lua_pushvalue(L, 2);
    lua_rawget(L, -2);
    return 1;
}

/// __eq is asked only for two objects of this kind: same length and same values.
int vector_equal(Call& call) {
    NumericBlock *a = to_vector(call.state(), 1), *b = to_vector(call.state(), 2);
    return call.give(a != nullptr && b != nullptr && a->rows == b->rows && a->vector() == b->vector());
}

constexpr std::array kVectorMethods = {Member{"range", guarded<vector_range>}, Member{"select", guarded<vector_select>},
                                       Member{"table", guarded<vector_table>}};

constexpr std::array kVectorOperators = {
    Member{"__add", guarded<numeric_add>},        Member{"__sub", guarded<numeric_subtract>},
    Member{"__mul", guarded<numeric_multiply>},   Member{"__div", guarded<numeric_divide>},
    Member{"__pow", guarded<numeric_power>},      Member{"__unm", guarded<numeric_negate>},
    Member{"__len", guarded<vector_length>},      Member{"__tostring", guarded<vector_tostring>},
    Member{"__lt", guarded<refuse_comparison>},   Member{"__le", guarded<refuse_comparison>},
    Member{"__newindex", guarded<write_element>}, Member{"__eq", guarded<vector_equal>},
    Member{"__named", guarded<vector_named>},
};

MaskBlock& mask_self(Call& call) {
    MaskBlock* mask = to_mask(call.state(), 1);
    if (mask == nullptr) wrong_argument(call.state(), 1, "mask", with_article("mask"));
    return *mask;
}

int mask_length(Call& call) {
    return call.give_integer(mask_self(call).size);
}

int mask_element(Call& call) {
    MaskBlock& mask = mask_self(call);
    return call.give(mask.data()[element_index(call.state(), 2, mask.size, "mask")]);
}

int mask_tostring(Call& call) {
    MaskBlock& mask = mask_self(call);
    return call.give(localized(
        call, Message("mask: {} of {} true", std::count(mask.data(), mask.data() + mask.size, true), mask.size)));
}

template <class Function>
int combine_masks(Call& call, Function function) {
    MaskBlock &a = mask_self(call), *b = to_mask(call.state(), 2);
    if (b == nullptr) wrong_argument(call.state(), 2, "other", with_article("mask"));
    if (a.size != b->size)
        throw InvalidArgument("the masks must have the same number of elements, but have {} and {}", a.size, b->size);
    std::transform(a.data(), a.data() + a.size, b->data(), push_mask(call.state(), a.size).data(), function);
    return 1;
}
int mask_both(Call& call) {
    return combine_masks(call, [](bool x, bool y) { return x && y; });
}
int mask_either(Call& call) {
    return combine_masks(call, [](bool x, bool y) { return x || y; });
}
int mask_opposite(Call& call) {
    MaskBlock& mask = mask_self(call);
    std::transform(mask.data(), mask.data() + mask.size, push_mask(call.state(), mask.size).data(),
                   std::logical_not<bool>());
    return 1;
}

constexpr std::array kMaskOperators = {Member{"__len", guarded<mask_length>},
                                       Member{"__tostring", guarded<mask_tostring>},
                                       Member{"__band", guarded<mask_both>}, Member{"__bor", guarded<mask_either>},
                                       Member{"__bnot", guarded<mask_opposite>}};

constexpr std::array kVectorTypes = {
    TypeEntry{&kVectorType, {}, kVectorMethods, kVectorOperators, guarded<read_element>},
    TypeEntry{&kMaskType, {}, {}, kMaskOperators, guarded<mask_element>}};

}  // namespace

TypeEntries vector_types() {
    return kVectorTypes;
}

}  // namespace dynlab::inline scripting
