#include "scripting/runtime/shown_calls.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "scripting/source/lua_reader.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMaxCalls = 1000;

/// Called alone for what they do, or print what they give.
constexpr const char* kForTheirEffect[] = {"advice", "require", "slider"};

/// Methods of vectors, matrices and data that change nothing and give a value: A:t(), data:split(0.6).
constexpr const char* kValueMethods[] = {"at",     "col",   "detrend", "discard",     "experiment", "filter",
                                         "keep",   "merge", "range",   "remove_mean", "resample",   "row",
                                         "select", "shift", "split",   "t",           "table",      "times"};

/// What each form of a signature gives: of "step(G, t) -> y, t, sd; step(G1, ...) -> fig" the texts "y, t, sd", "fig".
std::vector<std::string_view> results_of(std::string_view signature) {
    std::vector<std::string_view> results;
    for (std::size_t start = 0; start < signature.size();) {
        const std::string_view form = signature.substr(start, signature.find("; ", start) - start);
        const auto arrow = form.find("-> ");
        if (arrow != std::string_view::npos) results.push_back(form.substr(arrow + 3));
        start += form.size() + 2;
    }
    return results;
}

/// The names of several values, where each form gives the same and they are names.
std::vector<std::string> names_of(const std::vector<std::string_view>& results) {
    if (!std::all_of(results.begin(), results.end(), [&](auto& text) { return text == results.front(); })) return {};
    std::vector<std::string> names;
    const std::vector<LuaToken> tokens = lua_tokens(results.front());
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (i % 2 == 0 ? tokens[i].kind != LuaToken::Kind::kName : !tokens[i].is(",")) return {};
        if (i % 2 == 0) names.emplace_back(tokens[i].text);
    }
    return names.size() > 1 ? names : std::vector<std::string>{};
}

/// Whether the preceding tokens can be the end of a statement, or the beginning of a block.
bool begins_statement(const std::string& code, const std::vector<LuaToken>& tokens, std::size_t i) {
    if (!begins_line(code, tokens, i)) return false;
    if (i == 0) return true;
    const LuaToken& before = tokens[i - 1];
    for (const std::string_view word :
         {")", "]", "}", ";", "end", "then", "do", "else", "repeat", "nil", "true", "false"})
        if (before.is(word)) return true;
    return before.kind == LuaToken::Kind::kName || before.kind == LuaToken::Kind::kNumber ||
           before.kind == LuaToken::Kind::kString;
}

/// The last token of NAME(...), NAME{...} or NAME"...".
std::optional<std::size_t> end_of_call(const std::vector<LuaToken>& tokens, std::size_t name) {
    if (name + 1 >= tokens.size()) return std::nullopt;
    if (tokens[name + 1].kind == LuaToken::Kind::kString) return name + 1;
    if (!tokens[name + 1].is("(") && !tokens[name + 1].is("{")) return std::nullopt;
    int depth = 0;
    for (std::size_t i = name + 1; i < tokens.size(); ++i) {
        if (tokens[i].is("(") || tokens[i].is("{") || tokens[i].is("[")) ++depth;
        if ((tokens[i].is(")") || tokens[i].is("}") || tokens[i].is("]")) && --depth == 0) return i;
    }
    return std::nullopt;
}

bool next_begins_statement(const std::string& code, const std::vector<LuaToken>& tokens, std::size_t next) {
    if (next >= tokens.size()) return true;
    for (const std::string_view word : {"end", "else", "elseif", "until"})
        if (tokens[next].is(word)) return true;
    const bool word = tokens[next].kind == LuaToken::Kind::kName || tokens[next].kind == LuaToken::Kind::kKeyword;
    return word && begins_line(code, tokens, next) && !tokens[next].is("and") && !tokens[next].is("or");
}

/// Whether the script has redefined this name at the token `place`: as a local, a loop's variable or a parameter in a
/// block that is still open there, or as a global before it.
bool has_own_meaning(const std::string& code, const std::vector<LuaToken>& tokens, std::string_view name,
                     std::size_t place) {
    std::vector<bool> blocks = {false};  // the open ones: whether they define the name
    bool global = false, of_loop = false, in_parameters = false;
    const auto close = [&] {
        if (blocks.size() > 1) blocks.pop_back();
    };
    for (std::size_t i = 0; i < place; ++i) {
        const LuaToken& token = tokens[i];
        if (token.is("end") || token.is("until") || token.is("else") || token.is("elseif")) close();
        if (token.is("do") || token.is("then") || token.is("repeat") || token.is("else") || token.is("function"))
            blocks.push_back(std::exchange(of_loop, false));
        if (token.is("function")) in_parameters = true;
        if (token.is(")")) in_parameters = false;
        if (token.text != name) continue;
        std::size_t first = i;  // of a list of names
        while (first > 1 && tokens[first - 1].is(",") && tokens[first - 2].kind == LuaToken::Kind::kName) first -= 2;
        const auto behind = [&](const char* word) { return first > 0 && tokens[first - 1].is(word); };
        const bool assigned = i + 1 < tokens.size() && (tokens[i + 1].is("=") || tokens[i + 1].is(","));
        if (behind("function")) {
            if (first > 1 && tokens[first - 2].is("local"))
                blocks[blocks.size() - 2] = true;
            else
                global = true;
        } else if (in_parameters || behind("local")) {
            blocks.back() = true;
        } else if (behind("for")) {
            of_loop = true;
        } else if (assigned && begins_statement(code, tokens, first)) {
            global = true;
        }
    }
    return global || std::find(blocks.begin(), blocks.end(), true) != blocks.end();
}

/// Functions of Lua's own that only compute: math.sqrt(2), string.format(...).
bool of_lua_library(const std::vector<LuaToken>& tokens, std::size_t i) {
    return i + 2 < tokens.size() && (tokens[i].is("math") || tokens[i].is("string")) && tokens[i + 1].is(".") &&
           !tokens[i + 2].is("randomseed");
}

/// OBJECT:METHOD(...) that gives a value.
bool is_value_method(const std::vector<LuaToken>& tokens, std::size_t i) {
    return i + 2 < tokens.size() && tokens[i].kind == LuaToken::Kind::kName && tokens[i + 1].is(":") &&
           std::any_of(std::begin(kValueMethods), std::end(kValueMethods),
                       [&](const char* name) { return tokens[i + 2].is(name); });
}

}  // namespace

ShownCalls::ShownCalls(FunctionEntries functions) {
    for (const FunctionEntry& entry : functions) {
        const std::vector<std::string_view> results = results_of(entry.signature);
        if (results.empty() || results.front().find("fig") != std::string_view::npos) continue;
        names_[entry.name] = names_of(results);
    }
    for (const char* name : kForTheirEffect) names_.erase(name);
}

const std::vector<std::string>* ShownCalls::find(std::string_view function) const {
    const auto found = names_.find(function);
    return found == names_.end() ? nullptr : &found->second;
}

std::string with_shown_calls(const std::string& source, const ShownCalls& shown) {
    const std::vector<LuaToken> tokens = lua_tokens(source);
    std::string code = source;
    int calls = 0;
    for (std::size_t first = tokens.size(); first-- > 0 && calls < kMaxCalls;) {
        const std::vector<std::string>* const names_of_values = shown.find(tokens[first].text);
        const bool method = is_value_method(tokens, first), library = method || of_lua_library(tokens, first);
        if ((names_of_values == nullptr && !library) || !begins_statement(source, tokens, first)) continue;
        const std::optional<std::size_t> last = end_of_call(tokens, library ? first + 2 : first);
        if (!last || !next_begins_statement(source, tokens, *last + 1)) continue;
        ++calls;
        if (!method && has_own_meaning(source, tokens, tokens[first].text, first)) continue;
        const std::size_t begin = tokens[first].begin, length = tokens[*last].end() - begin;
        const std::string call = code.substr(begin, length);
        std::string shown_call = "dynlab.show(" + call + ")";
        if (!library && !names_of_values->empty()) {
            std::string names, fields;
            for (const std::string& name : *names_of_values) {
                names += (names.empty() ? "" : ", ") + name;
                fields += name + " = " + name + ", ";
            }
            shown_call = "do local " + names + " = " + call + " dynlab.show({" + fields + "}) end";
        }
        code.replace(begin, length, shown_call);
    }
    return LuaReader().error_of(code) ? source : code;
}

}  // namespace dynlab::inline scripting
