#include "app/live/state_questions.h"

#include "data_io/values/json_values.h"
#include "scripting/conversions/variable_list.h"
#include "scripting/prompt/completion.h"
#include "scripting/prompt/inspection.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline app {
namespace {

struct ShownCandidate {
    std::string text, note;
};
DYNLAB_DESCRIBE(ShownCandidate, text, note)

struct ShownCompletion {
    std::string typed;
    std::vector<ShownCandidate> candidates;
    std::string signature, summary;
    int argument = 0;
};
DYNLAB_DESCRIBE(ShownCompletion, typed, candidates, signature, summary, argument)

struct ShownHelp {
    std::string text;
};
DYNLAB_DESCRIBE(ShownHelp, text)

ShownCompletion completion_of(lua_State* L, const std::string& text) {
    constexpr std::size_t kMax = 200;  // more than a user reads
    Completion found = complete(L, text);
    if (found.candidates.size() > kMax) found.candidates.resize(kMax);
    ShownCompletion shown{text.substr(text.size() - found.typed), {}, {}, {}, 0};
    for (const std::string& candidate : found.candidates) {
        const FunctionEntry* const function = function_called(L, candidate);
        shown.candidates.push_back({candidate + found.closing, function ? signature_text(*function) : ""});
    }
    if (const auto call = call_around(L, text)) {
        shown.signature = signature_text(*call->function);
        shown.summary = call->function->summary;
        shown.argument = call->argument;
    }
    return shown;
}

int list_variables(lua_State* L) {
    *static_cast<std::vector<ListedVariable>*>(lua_touserdata(L, 1)) = variable_list(L);
    return 0;
}

/// Where the memory does not reach, none.
std::vector<ListedVariable> variables_of(lua_State* L) {
    std::vector<ListedVariable> variables;
    const int top = lua_gettop(L);
    lua_pushcfunction(L, list_variables);
    lua_pushlightuserdata(L, &variables);
    lua_pcall(L, 1, 0, 0);
    lua_settop(L, top);
    std::erase_if(variables, [](const ListedVariable& variable) { return variable.kind == "function"; });
    return variables;
}

}  // namespace

std::string answer_about_state(lua_State* L, const RunOrder& question) {
    if (question.question == "complete") return json_of(completion_of(L, question.text));
    if (question.question == "variables") return json_of(variables_of(L));
    return json_of(ShownHelp{inspect(L, question.text, question.cursor).value_or("")});
}

}  // namespace dynlab::inline app
