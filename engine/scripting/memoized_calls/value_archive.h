#pragma once
#include "data_io/values/cbor_values.h"
#include "scripting/conversions/arguments.h"
#include "scripting/runtime/recorder.h"

namespace dynlab::inline scripting {

/// Writes the value of a script at a stack index, with the entire content of tables. Returns false, after writing some
/// data, for values without lasting content: functions, coroutines, tables with metatables or too many levels.
bool put_value(lua_State* L, int index, CborWriter& archive);

/// Pushes an equal value. The figures among it are added to `figures`; the recorder does not know them yet. Throws
/// ValueError for bytes that hold none.
void push_archived_value(const Call& call, CborReader& archive, std::vector<FigurePointer>& figures);

}  // namespace dynlab::inline scripting
