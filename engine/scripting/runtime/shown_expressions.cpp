#include "scripting/runtime/shown_expressions.h"

#include <algorithm>
#include <lua.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scripting/runtime/errors.h"
#include "scripting/runtime/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMostExpressions = 1000;
constexpr int kMostLines = 40;  // of one expression

/// Where Lua stops reading: the token, as an index into the tokens (their number at the end of the source).
struct Stop {
    std::size_t token = 0;
    std::size_t offset = 0;
};

/// Reads Lua text in a state of its own, which runs nothing.
class LuaReader {
  public:
    LuaReader() : state_(luaL_newstate(), lua_close) {}

    /// The message of a syntax error, nothing for text that is Lua.
    std::optional<std::string> error_of(const std::string& code) {
        if (!state_) return "no memory";
        lua_State* L = state_.get();
        lua_settop(L, 0);
        if (luaL_loadbufferx(L, code.data(), code.size(), "=s", "t") == LUA_OK) return std::nullopt;
        std::size_t length = 0;
        const char* text = lua_tolstring(L, -1, &length);
        return std::string(text, length);
    }

  private:
    std::unique_ptr<lua_State, void (*)(lua_State*)> state_;
};

std::size_t line_start(const std::string& code, int line) {
    std::size_t start = 0;
    for (int i = 1; i < line; ++i) {
        start = code.find('\n', start);
        if (start == std::string::npos) return code.size();
        ++start;
    }
    return start;
}

bool begins_line(const std::string& code, const std::vector<LuaToken>& tokens, std::size_t i) {
    if (i == 0) return true;
    const std::string_view between =
        std::string_view(code).substr(tokens[i - 1].end(), tokens[i].begin - tokens[i - 1].end());
    return between.find('\n') != std::string_view::npos;
}

/// The tokens where Lua may have stopped: those of the line that read like the one it names.
std::vector<std::size_t> stops_of(const std::string& message, const std::string& code,
                                  const std::vector<LuaToken>& tokens) {
    if (message.ends_with("near <eof>")) return {tokens.size()};
    const int line = take_apart(message).line;
    const auto at = message.rfind(" near '");
    if (at == std::string::npos || line == 0) return {};
    const std::string word = message.substr(at + 7, message.size() - at - 8);
    const std::size_t first = line_start(code, line), last = line_start(code, line + 1);
    std::vector<std::size_t> stops;
    for (std::size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i].begin >= first && tokens[i].begin < last && tokens[i].text == word) stops.push_back(i);
    return stops;
}

bool ends_statement(const std::string& code, const std::vector<LuaToken>& tokens, std::size_t next) {
    if (next >= tokens.size() || begins_line(code, tokens, next)) return true;
    for (const std::string_view word : {";", "end", "else", "elseif", "until"})
        if (tokens[next].is(word)) return true;
    return false;
}

/// A length begins with # right before what it counts; "# text" is somebody's comment.
bool may_begin_expression(const std::vector<LuaToken>& tokens, std::size_t i) {
    if (tokens[i].is("#")) return i + 1 < tokens.size() && tokens[i + 1].begin == tokens[i].end();
    return tokens[i].kind != LuaToken::Kind::kKeyword || tokens[i].is("not") || tokens[i].is("nil") ||
           tokens[i].is("true") || tokens[i].is("false") || tokens[i].is("function");
}

/// The source with the expression made a call in which Lua stopped at this token, or before it.
std::optional<std::string> rewritten(LuaReader& reader, const std::string& code, const std::vector<LuaToken>& tokens,
                                     std::size_t stop) {
    int lines = 0;
    for (std::size_t first = std::min(stop, tokens.size() - 1) + 1; first-- > 0 && lines <= kMostLines;) {
        if (!begins_line(code, tokens, first)) continue;
        ++lines;
        if (first > 0 && tokens[first - 1].is("...")) return std::nullopt;  // a line that MATLAB would go on with
        if (first == stop && stop > 0 && !may_begin_expression(tokens, first)) continue;
        if (!may_begin_expression(tokens, first)) return std::nullopt;
        for (std::size_t last = first; last < tokens.size() && last <= stop + 200; ++last) {
            if (last + 1 < stop || !ends_statement(code, tokens, last + 1)) continue;
            const std::size_t begin = tokens[first].begin, length = tokens[last].end() - begin;
            const std::string expression = code.substr(begin, length);
            if (reader.error_of("show(" + expression + ")")) continue;
            const bool silent = last + 1 < tokens.size() && tokens[last + 1].is(";");
            const std::string statement = silent ? "local _ = " + expression : "dynlab.show(" + expression + ");";
            return code.substr(0, begin) + statement + code.substr(begin + length);
        }
    }
    return std::nullopt;
}

std::string with_shown_values(const std::string& source) {
    LuaReader reader;
    std::string code = source;
    std::size_t reached = 0;
    for (int i = 0; i < kMostExpressions; ++i) {
        const std::optional<std::string> error = reader.error_of(code);
        if (!error) return code;
        const std::vector<LuaToken> tokens = lua_tokens(code);
        if (tokens.empty()) return source;
        std::optional<std::string> next;
        for (const std::size_t stop : stops_of(*error, code, tokens)) {
            next = rewritten(reader, code, tokens, stop);
            if (next) break;
        }
        if (!next) return source;
        // Each call must bring Lua further, or the guess was wrong.
        const std::optional<std::string> after = reader.error_of(*next);
        const std::size_t line = after ? static_cast<std::size_t>(take_apart(*after).line) : std::string::npos;
        if (after && line < reached) return source;
        reached = line;
        code = std::move(*next);
    }
    return source;
}

/// Functions that only compute, and the names of what they give where that is more than one value.
const std::map<std::string_view, std::string_view> kShownCalls = {{"damp", "wn, zeta, T"},
                                                                  {"margin", "Gm, Pm, Wcg, Wcp, Dm"},
                                                                  {"pole", ""},
                                                                  {"zero", ""},
                                                                  {"dcgain", ""},
                                                                  {"bandwidth", ""},
                                                                  {"stable", ""},
                                                                  {"fit", ""},
                                                                  {"mean", ""},
                                                                  {"median", ""},
                                                                  {"std", ""},
                                                                  {"var", ""},
                                                                  {"sum", ""},
                                                                  {"norm", ""},
                                                                  {"det", ""},
                                                                  {"eig", ""},
                                                                  {"inv", ""},
                                                                  {"polyfit", ""}};

std::vector<std::string> listed_names(const std::string& list) {
    std::vector<std::string> names;
    for (const LuaToken& token : lua_tokens(list))
        if (token.kind == LuaToken::Kind::kName) names.emplace_back(token.text);
    return names;
}

/// Whether what stands before can be the end of a statement, or the beginning of a block.
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

/// The bracket that closes NAME(...).
std::optional<std::size_t> end_of_call(const std::vector<LuaToken>& tokens, std::size_t name) {
    if (name + 1 >= tokens.size() || !tokens[name + 1].is("(")) return std::nullopt;
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

/// Whether the script has given this name a meaning of its own that holds at the token `place`: a local, a loop's
/// variable or a parameter in a block that is still open there, or a global before it.
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

}  // namespace

std::string with_shown_calls(const std::string& source) {
    const std::vector<LuaToken> tokens = lua_tokens(source);
    std::string code = source;
    for (std::size_t first = tokens.size(); first-- > 0;) {
        const auto names = kShownCalls.find(tokens[first].text);
        if (names == kShownCalls.end() || !begins_statement(source, tokens, first)) continue;
        if (has_own_meaning(source, tokens, names->first, first)) continue;
        const std::optional<std::size_t> last = end_of_call(tokens, first);
        if (!last || !next_begins_statement(source, tokens, *last + 1)) continue;
        const std::size_t begin = tokens[first].begin, length = tokens[*last].end() - begin;
        const std::string call = code.substr(begin, length), all(names->second);
        std::string fields;
        for (const std::string& name : listed_names(all)) fields += name + " = " + name + ", ";
        code.replace(begin, length,
                     all.empty() ? "dynlab.show(" + call + ")"
                                 : "do local " + all + " = " + call + " dynlab.show({" + fields + "}) end");
    }
    return LuaReader().error_of(code) ? source : code;
}

std::string with_shown_expressions(const std::string& source) {
    return with_shown_calls(with_shown_values(source));
}

std::optional<int> line_with_semicolon_rows(const std::string& source) {
    const std::vector<LuaToken> tokens = lua_tokens(source);
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (!tokens[i].is("matrix") || !tokens[i + 1].is("{")) continue;
        int depth = 0;
        for (std::size_t k = i + 1; k < tokens.size() && !tokens[k].is("function"); ++k) {
            if (tokens[k].is("{")) ++depth;
            if (tokens[k].is("}") && --depth == 0) break;
            if (tokens[k].is(";"))
                return 1 + static_cast<int>(std::count(
                               source.begin(), source.begin() + static_cast<std::ptrdiff_t>(tokens[k].begin), '\n'));
        }
    }
    return std::nullopt;
}

constexpr int kMostLooks = 200;  // each may go through the whole source

std::optional<int> line_with_compared_place(const std::string& source) {
    const std::vector<LuaToken> tokens = lua_tokens(source);
    const auto extreme = [&](std::size_t i) { return tokens[i].is("max") || tokens[i].is("min"); };
    // The place of the bracket that closes the one at `open`, and whether a comma stands between them.
    const auto closing = [&](std::size_t open) {
        int depth = 0;
        bool comma = false;
        std::size_t i = open;
        for (; i < tokens.size(); ++i) {
            if (tokens[i].is("(") || tokens[i].is("{") || tokens[i].is("[")) ++depth;
            if ((tokens[i].is(")") || tokens[i].is("}") || tokens[i].is("]")) && --depth == 0) break;
            comma = comma || (depth == 1 && tokens[i].is(","));
        }
        return std::pair(i, comma);
    };
    // A max or min of the script's own gives what its author says.
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        const bool given = extreme(i) && tokens[i + 1].is("=");
        if (given || (extreme(i + 1) && (tokens[i].is("function") || tokens[i].is("local")))) return std::nullopt;
    }
    int looks = 0;
    for (std::size_t i = 0; i + 3 < tokens.size() && looks < kMostLooks; ++i) {
        if (!tokens[i].is("math") || !tokens[i + 1].is(".") || !extreme(i + 2) || !tokens[i + 3].is("(")) continue;
        ++looks;
        const std::size_t end = closing(i + 3).first;
        for (std::size_t k = i + 4; k + 1 < end; ++k) {
            if (!extreme(k) || !tokens[k + 1].is("(") || (!tokens[k - 1].is(",") && !tokens[k - 1].is("("))) continue;
            const auto [last, of_two] = closing(k + 1);
            if (last + 1 == end && !of_two && (tokens[k - 1].is(",") || k == i + 4))
                return 1 + static_cast<int>(std::count(
                               source.begin(), source.begin() + static_cast<std::ptrdiff_t>(tokens[k].begin), '\n'));
        }
    }
    return std::nullopt;
}

std::optional<DecimalComma> decimal_comma_of(const std::string& source) {
    const std::vector<LuaToken> tokens = lua_tokens(source);
    const auto whole = [](const LuaToken& token) {
        return token.kind == LuaToken::Kind::kNumber && token.text.find_first_not_of("0123456789") == token.text.npos;
    };
    int depth = 0;  // of brackets, in which commas separate entries
    for (std::size_t i = 0; i + 4 < tokens.size(); ++i) {
        if (tokens[i].is("(") || tokens[i].is("{") || tokens[i].is("[")) ++depth;
        if (tokens[i].is(")") || tokens[i].is("}") || tokens[i].is("]")) --depth;
        const bool alone = i == 0 || (!tokens[i - 1].is(",") && !tokens[i - 1].is("for"));
        if (depth != 0 || !alone || tokens[i].kind != LuaToken::Kind::kName || !tokens[i + 1].is("=")) continue;
        const LuaToken &left = tokens[i + 2], &comma = tokens[i + 3], &right = tokens[i + 4];
        if (!whole(left) || !whole(right) || !comma.is(",") || comma.begin != left.end() || right.begin != comma.end())
            continue;
        const auto before = source.begin() + static_cast<std::ptrdiff_t>(left.begin);
        return DecimalComma{1 + static_cast<int>(std::count(source.begin(), before, '\n')), std::string(tokens[i].text),
                            std::string(left.text), std::string(right.text)};
    }
    return std::nullopt;
}

}  // namespace dynlab::inline scripting
