#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"

namespace dynlab::inline scripting {

/// Numerics names its options in backticks, `max_iterations`, and knows no word of Lua: here they become the names that
/// scripts use, MaxIter. Other text in backticks stays as it is.
std::string in_lua_words(std::string_view message);
/// In English.
std::string in_lua_words(const Message& message);

/// The name that scripts use for an option of numerics, MaxIter for max_iterations; in backticks where they have none.
std::string lua_option_name(std::string_view member);

/// The names of numerics' options that in_lua_words() knows.
std::vector<std::string> translated_options();

/// The name with its first letter in the other case: MATLAB's options are a mixture, Lambda and lambda.
std::string with_other_case(std::string name);

/// About an option that is none of these.
std::string unknown_option_sentence(const std::string& name, const std::vector<std::string>& known);

}  // namespace dynlab::inline scripting
