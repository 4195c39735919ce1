#include "scripting/runtime/shown_expressions.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "scripting/runtime/errors.h"
#include "scripting/source/lua_reader.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMaxExpressions = 1000;
constexpr int kMaxLineCount = 40;  // of one expression

/// Where Lua stops reading: the token, as an index into the tokens (their number at the end of the source).
struct Stop {
    std::size_t token = 0;
    std::size_t offset = 0;
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

/// A length begins with # directly before its operand; "# text" is a comment in another language.
bool may_begin_expression(const std::vector<LuaToken>& tokens, std::size_t i) {
    if (tokens[i].is("#")) return i + 1 < tokens.size() && tokens[i + 1].begin == tokens[i].end();
    return tokens[i].kind != LuaToken::Kind::kKeyword || tokens[i].is("not") || tokens[i].is("nil") ||
           tokens[i].is("true") || tokens[i].is("false") || tokens[i].is("function");
}

/// The source with the expression made a call in which Lua stopped at this token, or before it.
std::optional<std::string> rewritten(LuaReader& reader, const std::string& code, const std::vector<LuaToken>& tokens,
                                     std::size_t stop) {
    int lines = 0;
    for (std::size_t first = std::min(stop, tokens.size() - 1) + 1; first-- > 0 && lines <= kMaxLineCount;) {
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
    for (int i = 0; i < kMaxExpressions; ++i) {
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
        // Each added call must bring Lua further; otherwise the assumption was wrong.
        const std::optional<std::string> after = reader.error_of(*next);
        const std::size_t line = after ? static_cast<std::size_t>(take_apart(*after).line) : std::string::npos;
        if (after && line < reached) return source;
        reached = line;
        code = std::move(*next);
    }
    return source;
}

}  // namespace

std::string with_shown_expressions(const std::string& source, const ShownCalls& shown) {
    return with_shown_calls(with_shown_values(source), shown);
}

namespace {

using LuaTokens = std::vector<LuaToken>;

int line_of(const std::string& source, const LuaToken& token) {
    return 1 + static_cast<int>(
                   std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(token.begin), '\n'));
}

std::optional<int> line_with_semicolon_rows(const std::string& source, const LuaTokens& tokens) {
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (!tokens[i].is("matrix") || !tokens[i + 1].is("{")) continue;
        int depth = 0;
        for (std::size_t k = i + 1; k < tokens.size() && !tokens[k].is("function"); ++k) {
            if (tokens[k].is("{")) ++depth;
            if (tokens[k].is("}") && --depth == 0) break;
            if (tokens[k].is(";")) return line_of(source, tokens[k]);
        }
    }
    return std::nullopt;
}

constexpr int kMaxLookups = 200;  // each may go through the whole source

std::optional<int> line_with_compared_place(const std::string& source, const LuaTokens& tokens) {
    const auto extreme = [&](std::size_t i) { return tokens[i].is("max") || tokens[i].is("min"); };
    // The place of the bracket that closes the one at `open`, and whether there is a comma between them.
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
    for (std::size_t i = 0; i + 3 < tokens.size() && looks < kMaxLookups; ++i) {
        if (!tokens[i].is("math") || !tokens[i + 1].is(".") || !extreme(i + 2) || !tokens[i + 3].is("(")) continue;
        ++looks;
        const std::size_t end = closing(i + 3).first;
        for (std::size_t k = i + 4; k + 1 < end; ++k) {
            if (!extreme(k) || !tokens[k + 1].is("(") || (!tokens[k - 1].is(",") && !tokens[k - 1].is("("))) continue;
            const auto [last, of_two] = closing(k + 1);
            if (last + 1 == end && !of_two && (tokens[k - 1].is(",") || k == i + 4)) return line_of(source, tokens[k]);
        }
    }
    return std::nullopt;
}

/// A number written with a decimal comma, and its line.
struct DecimalComma {
    int line;
    std::string name, whole, fraction;
};

std::optional<DecimalComma> decimal_comma_of(const std::string& source, const LuaTokens& tokens) {
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
        return DecimalComma{line_of(source, left), std::string(tokens[i].text), std::string(left.text),
                            std::string(right.text)};
    }
    return std::nullopt;
}

}  // namespace

std::optional<MisreadLine> misread_line_of(const std::string& source) {
    const LuaTokens tokens = lua_tokens(source);
    if (const std::optional<int> line = line_with_semicolon_rows(source, tokens))
        return MisreadLine{
            *line,
            Message(
                "each row of a matrix is a table: matrix{{1, 2}, {3, 4}}; a semicolon separates entries like a comma")};
    if (const std::optional<int> line = line_with_compared_place(source, tokens))
        return MisreadLine{*line, Message("max(v) and min(v) also return the index of the element, which math.max and "
                                          "math.min would treat as another value: write math.max(x, (max(v)))")};
    if (const std::optional<DecimalComma> number = decimal_comma_of(source, tokens)) {
        const auto& [line, name, whole, fraction] = *number;
        return MisreadLine{line, Message("{} = {},{} assigns {} the value {}: use a decimal point, {}.{}", name, whole,
                                         fraction, name, whole, whole, fraction)};
    }
    return std::nullopt;
}

}  // namespace dynlab::inline scripting
