#pragma once
#include <lua.hpp>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline scripting {

/// A script's named answer, in a form that another process can read: JSON, {"kind": K, ...} with K one of
/// answer_kinds() (documents/percent_script.h). Numbers have 17 digits; numbers that JSON lacks are the texts "NaN",
/// "Infinity" and "-Infinity".
struct AnswerValue {
    std::string kind, json;
};

/// The kind of an answer that a graded script gave wrongly, or twice: {"kind": "refused", "why": a clause}.
inline constexpr char kRefusedAnswer[] = "refused";

/// The value at stack index `index`. Throws InvalidArgument, in words for the script's writer, for values of other
/// kinds (functions, figures), tables that contain themselves or are nested deeper than 8, and more than 500,000
/// numbers.
AnswerValue answer_value(lua_State* L, int index);

/// Pushes the value again. Throws InvalidArgument where the text is not what answer_value makes: it may come from
/// anybody.
void push_answer_value(lua_State* L, const std::string& json);

/// About an answer that the script's header does not declare; it declares `names`.
Message undeclared_answer(const std::string& name, const std::vector<std::string>& names);

}  // namespace dynlab::inline scripting
