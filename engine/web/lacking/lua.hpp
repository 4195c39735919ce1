#pragma once
/// Lua compiled as C++ (its errors are exceptions), with the names of C++: Debian's own header is for its library, whose names
/// are those of C.
#include "lua.h"
#include "lualib.h"

#include "lauxlib.h"
