#include "scripting/prompt/completion.h"

#include <algorithm>
#include <filesystem>

#include "data_io/dataset_index.h"
#include "scripting/conversions/value_members.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/help.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

using Tokens = std::vector<LuaToken>;
using Kind = LuaToken::Kind;

bool is_word(const LuaToken& token) {
    return token.kind == Kind::kName || token.kind == Kind::kKeyword;
}

/// Names joined by dots and colons that end with the last of `tokens`: a.b:c gives {a, b, c}; empty when none do.
std::vector<std::string_view> chain_at_end(const Tokens& tokens) {
    std::vector<std::string_view> chain;
    auto token = tokens.rbegin();
    while (token != tokens.rend() && token->kind == Kind::kName) {
        chain.insert(chain.begin(), token->text);
        if (++token == tokens.rend() || !(token->is(".") || token->is(":"))) return chain;
        ++token;
    }
    return {};
}

/// The context of the cursor: the call around it, and whether it is in braces directly inside the call's brackets.
struct Surroundings {
    std::string function;  ///< "" if the cursor is in no call
    bool in_braces = false;
    int argument = 0;  ///< commas of the call before the cursor
};

/// Commas of the innermost bracket, which opens before `begin`.
int commas_behind(const Tokens& tokens, std::size_t begin) {
    int depth = 0, commas = 0;
    for (std::size_t i = begin; i < tokens.size(); ++i) {
        if (tokens[i].is("(") || tokens[i].is("{") || tokens[i].is("[")) ++depth;
        if (tokens[i].is(")") || tokens[i].is("}") || tokens[i].is("]")) --depth;
        if (tokens[i].is(",") && depth == 0) ++commas;
    }
    return commas;
}

/// The innermost bracket left open, and the name before it: f(, f{ or f(..., {.
Surroundings surroundings_of(const Tokens& tokens) {
    int closed = 0;
    Surroundings found;
    for (std::size_t i = tokens.size(); i-- > 0;) {
        const LuaToken& token = tokens[i];
        if (token.is(")") || token.is("}") || token.is("]")) ++closed;
        if (!token.is("(") && !token.is("{") && !token.is("[")) continue;
        if (closed-- > 0) continue;
        closed = 0;
        const bool after_name = i > 0 && tokens[i - 1].kind == Kind::kName;
        if (token.is("{") && !found.in_braces)
            found.in_braces = true;
        else if (!token.is("("))
            return {};
        if (!after_name && token.is("{")) continue;
        if (!after_name) return {};
        for (std::string_view link : chain_at_end(Tokens(tokens.begin(), tokens.begin() + static_cast<long>(i))))
            found.function += (found.function.empty() ? "" : ".") + std::string(link);
        found.argument = token.is("(") ? commas_behind(tokens, i + 1) : 0;
        return found;
    }
    return {};
}

std::vector<std::string> options_of(const FunctionEntry& entry) {
    std::vector<std::string> names = option_names(entry.options);
    for (std::string& name : names) name += " = ";
    return names;
}

std::vector<std::string> names_of_data() {
    namespace fs = std::filesystem;
    std::vector<std::string> names;
    try {
        names = dataset_names();
        for (const auto& entry : fs::directory_iterator(".", fs::directory_options::skip_permission_denied))
            if (entry.path().extension() == ".csv" || entry.path().extension() == ".mat")
                names.push_back(entry.path().filename());
    } catch (const std::exception&) {  // a folder that cannot be read offers no names
    }
    return names;
}

std::vector<std::string> names_of_help(lua_State* L) {
    std::vector<std::string> names;
    for (const FunctionEntry* entry : context_of(L).functions) names.emplace_back(entry->name);
    for (const HelpPage& page : help_pages()) names.emplace_back(page.name);
    return names;
}

/// The words of the text itself: what a statement that is not complete yet declares.
std::vector<std::string> names_in(const Tokens& tokens) {
    std::vector<std::string> names;
    for (const LuaToken& token : tokens)
        if (token.kind == Kind::kName) names.emplace_back(token.text);
    return names;
}

Completion choose(std::string_view typed, std::vector<std::string> names) {
    std::erase_if(names, [&](const std::string& name) { return !name.starts_with(typed); });
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    Completion completion;
    completion.typed = typed.size();
    completion.candidates = std::move(names);
    return completion;
}

void append(std::vector<std::string>& names, std::vector<std::string> more) {
    names.insert(names.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// load("na and help("na: the open string is the last token, and the function precedes it.
Completion complete_string(lua_State* L, const Tokens& tokens) {
    Tokens before(tokens.begin(), tokens.end() - 1);
    if (!before.empty() && before.back().is("(")) before.pop_back();
    const std::string_view quoted = tokens.back().text;
    if (before.empty() || (quoted.front() != '"' && quoted.front() != '\'')) return {};
    Completion completion;
    if (before.back().is("load")) completion = choose(quoted.substr(1), names_of_data());
    if (before.back().is("help")) completion = choose(quoted.substr(1), names_of_help(L));
    completion.closing = quoted.front();
    return completion;
}

Completion complete_member(lua_State* L, Tokens before, std::string_view typed) {
    const MemberKind kind = before.back().is(":") ? MemberKind::kMethod : MemberKind::kField;
    before.pop_back();
    const auto chain = chain_at_end(before);
    const int top = lua_gettop(L);
    Completion completion;
    if (!chain.empty() && push_value_of(L, chain)) completion = choose(typed, member_names(L, kind));
    lua_settop(L, top);
    return completion;
}

Completion complete_word(lua_State* L, const Tokens& before, std::string_view typed) {
    const Surroundings surroundings = surroundings_of(before);
    const FunctionEntry* function = surroundings.function.empty() ? nullptr : function_called(L, surroundings.function);
    const bool starts_item = !before.empty() && (before.back().is("{") || before.back().is(","));
    std::vector<std::string> names;
    if (function != nullptr && surroundings.in_braces && starts_item) names = options_of(*function);
    Completion completion = choose(typed, std::move(names));
    if (typed.empty() && function != nullptr) completion.note = signature_text(*function);
    if (typed.empty() || !completion.candidates.empty()) return completion;
    names = visible_names(L);
    append(names, names_in(before));
    for (std::string_view word : lua_keywords()) names.emplace_back(word);
    return choose(typed, std::move(names));
}

struct Request {
    std::string_view text;
    Completion completion;
};

int complete_protected(lua_State* L) {
    auto& request = *static_cast<Request*>(lua_touserdata(L, 1));
    Tokens tokens = lua_tokens(request.text);
    if (tokens.empty()) return 0;
    if (tokens.back().kind == Kind::kUnfinished) {
        request.completion = complete_string(L, tokens);
        return 0;
    }
    std::string_view typed;
    if (is_word(tokens.back()) && tokens.back().end() == request.text.size()) {
        typed = tokens.back().text;
        tokens.pop_back();
    }
    const bool member = !tokens.empty() && (tokens.back().is(".") || tokens.back().is(":"));
    request.completion = member ? complete_member(L, std::move(tokens), typed) : complete_word(L, tokens, typed);
    return 0;
}

}  // namespace

const FunctionEntry* function_called(lua_State* L, std::string_view name) {
    for (const FunctionEntry* entry : context_of(L).functions)
        if (name == entry->name) return entry;
    return nullptr;
}

std::optional<CallAtCursor> call_around(lua_State* L, std::string_view text) {
    Tokens tokens = lua_tokens(text);
    if (!tokens.empty() && tokens.back().kind == Kind::kUnfinished) tokens.pop_back();
    const Surroundings surroundings = surroundings_of(tokens);
    const FunctionEntry* const function = function_called(L, surroundings.function);
    return function == nullptr ? std::nullopt : std::optional(CallAtCursor{function, surroundings.argument});
}

std::string Completion::common_rest() const {
    if (candidates.empty()) return {};
    // Sorted words share what the first and the last share.
    const std::string &first = candidates.front(), &last = candidates.back();
    const auto end = std::mismatch(first.begin(), first.end(), last.begin(), last.end()).first;
    return std::string(first.begin() + static_cast<long>(typed), end) + (candidates.size() == 1 ? closing : "");
}

Completion complete(lua_State* L, std::string_view text) {
    const int top = lua_gettop(L);
    Request request{text, {}};
    lua_pushcfunction(L, complete_protected);
    lua_pushlightuserdata(L, &request);
    if (lua_pcall(L, 1, 0, 0) != LUA_OK) request.completion = {};
    lua_settop(L, top);
    return std::move(request.completion);
}

}  // namespace dynlab::inline scripting
