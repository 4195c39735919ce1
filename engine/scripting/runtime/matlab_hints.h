#pragma once
#include <string>

namespace dynlab::inline scripting {

/// What to write instead of a MATLAB function that has no namesake here ("write print(x)"); nullptr when unknown.
const char* matlab_name_hint(const std::string& name);

/// The Lua form of a MATLAB habit seen in a line that Lua cannot read; empty when none is recognised. `near` is the
/// token at which Lua gave up.
std::string matlab_syntax_hint(const std::string& line, const std::string& near);

}  // namespace dynlab::inline scripting
