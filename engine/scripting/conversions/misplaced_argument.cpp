#include "scripting/conversions/misplaced_argument.h"

#include <string>
#include <string_view>

#include "base/reader.h"
#include "platform/text/small_letters.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/object_type.h"
#include "scripting/runtime/kind_phrases.h"

namespace dynlab::inline scripting {
namespace {

/// The argument's own name as the only key of a table, as in lssvf(data, orders, {lambda = 3}); empty otherwise.
std::string own_name_as_key(lua_State* L, int index, const Message& label) {
    if (!lua_istable(L, index)) return {};
    index = lua_absindex(L, index);
    lua_pushnil(L);
    if (lua_next(L, index) == 0) return {};
    std::string key = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "";
    lua_pop(L, 2);
    const bool is_named =
        !key.empty() && in_small_letters(message_text(label)).ends_with("(" + in_small_letters(key) + ")");
    return is_named ? key : "";
}

/// The number of the argument that is an iddata object; 0 if there is none.
int place_of_data(lua_State* L) {
    for (int i = 1; i <= lua_gettop(L); ++i)
        if (lua_type(L, i) == LUA_TUSERDATA && std::string_view(object_name(L, i)) == "iddata") return i;
    return 0;
}

}  // namespace

void refuse_misplaced(lua_State* L, int index, const Message& label, const Message& requested, const Message& given) {
    if (const std::string key = own_name_as_key(L, index, label); !key.empty())
        throw InvalidArgument("{} must be {}, but {} was given; write the value alone, without {{} = ...}", label,
                              requested, given, key);
    if (const int data = place_of_data(L); data > index && requested == with_article("iddata"))
        throw InvalidArgument("{} must be {}, but {} was given; the iddata object is argument {}: change the order",
                              label, requested, given, data);
}

}  // namespace dynlab::inline scripting
