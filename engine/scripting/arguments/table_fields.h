#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scripting/arguments/arguments.h"

namespace dynlab::inline scripting {

/// Each sets a field of the table on top of the stack, which stays there.
void set_number(lua_State* L, const char* name, double value);
void set_integer(lua_State* L, const char* name, Index value);
void set_flag(lua_State* L, const char* name, bool value);
void set_text(const Call& call, const char* name, const std::string& value);
void set_texts(const Call& call, const char* name, const std::vector<std::string>& texts);
void set_vector(const Call& call, const char* name, const VectorView& values);
void set_matrix(const Call& call, const char* name, const MatrixView& values);

/// From now on reading a field that the table on top of the stack has not is an error that lists those it has; `name`
/// is that of the data.
void refuse_unknown_fields(lua_State* L, const std::string& name);
/// Gives the data table below the table on top of the stack, which is taken off, that one's fields: they are read like
/// its own and not listed.
void add_hidden_fields(lua_State* L);
/// The name of the data in the table at `index`, when refuse_unknown_fields() was called for it.
std::optional<std::string> name_of_refusing_table(lua_State* L, int index);

}  // namespace dynlab::inline scripting
