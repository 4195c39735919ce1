#pragma once
#include <string_view>

#include "base/message.h"

namespace dynlab::inline scripting {

/// Phrases for the kinds of values, by the names that Lua and the object types have for them: "a model", "an iddata".
Message with_article(std::string_view kind);
/// "the model"
Message with_the(std::string_view kind);
/// As a property of a variable: "nil (it has no value)", "true or false", "an object".
Message what_it_is(std::string_view kind);

}  // namespace dynlab::inline scripting
