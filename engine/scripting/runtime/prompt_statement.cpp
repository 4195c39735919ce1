#include "scripting/runtime/prompt_statement.h"

#include <re2/re2.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "scripting/runtime/shown_expressions.h"
#include "scripting/source/lua_reader.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

using Tokens = std::vector<LuaToken>;

enum class Syntax { kRight, kIncomplete, kWrong };

/// Asks Lua itself whether it can read the text and whether only its end is missing.
Syntax syntax_of(std::string code) {
    code += '\n';  // so that a quote left open is wrong at the end of its line
    const std::optional<std::string> error = LuaReader().error_of(code);
    if (!error) return Syntax::kRight;
    return error->ends_with("<eof>") ? Syntax::kIncomplete : Syntax::kWrong;
}

int depth_change(const LuaToken& token) {
    if (token.kind != LuaToken::Kind::kKeyword) return 0;
    for (std::string_view opening : {"function", "do", "if", "repeat"})
        if (token.is(opening)) return 1;
    return token.is("end") || token.is("until") ? -1 : 0;
}

/// Rewrites the declarations `local` of the outermost level into assignments, in place: the other text keeps its lines.
class LocalsToAssignments {
  public:
    LocalsToAssignments(const std::string& source, const Tokens& tokens) : code_(source), tokens_(tokens) {
        int depth = 0;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (depth == 0 && tokens_[i].is("local")) rewrite(i);
            depth += depth_change(tokens_[i]);
        }
        for (auto offset = missing_values_.rbegin(); offset != missing_values_.rend(); ++offset)
            code_.insert(*offset, " = nil");
    }

    const std::string& code() const { return code_; }
    const std::vector<std::string>& names() const { return names_; }

  private:
    bool is(std::size_t i, std::string_view word) const { return i < tokens_.size() && tokens_[i].is(word); }
    bool is_name(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == LuaToken::Kind::kName; }
    void blank(std::size_t first, std::size_t last) {
        const std::size_t begin = tokens_[first].begin;
        for (std::size_t i = begin; i < tokens_[last].end(); ++i)
            if (code_[i] != '\n') code_[i] = ' ';
    }

    void rewrite(std::size_t local) {
        if (is(local + 1, "function")) {
            if (is_name(local + 2)) names_.emplace_back(tokens_[local + 2].text);
            return blank(local, local);
        }
        std::vector<std::string> names;
        std::vector<std::size_t> attributes;
        std::size_t i = local + 1;
        for (;; ++i) {
            if (!is_name(i)) return;
            names.emplace_back(tokens_[i++].text);
            if (is(i, "<")) {
                if (!is(i + 1, "const") || !is(i + 2, ">")) return;  // <close> is tied to the block's end
                attributes.push_back(i);
                i += 3;
            }
            if (!is(i, ",")) break;
        }
        for (std::size_t attribute : attributes) blank(attribute, attribute + 2);
        blank(local, local);
        if (!is(i, "=")) missing_values_.push_back(tokens_[i - 1].end());
        names_.insert(names_.end(), names.begin(), names.end());
    }

    std::string code_;
    const Tokens& tokens_;
    std::vector<std::string> names_;
    std::vector<std::size_t> missing_values_;
};

/// The word typed by habit as Lua; nothing when it is not one.
std::optional<std::string> without_habit(const std::string& source, const Tokens& tokens) {
    static const RE2 help(R"(\s*help(?:\s+([\w.]+))?\s*;?\s*)", RE2::Latin1);
    std::string topic;
    if (tokens.size() <= 5 && RE2::FullMatch(source, help, &topic))
        return topic.empty() ? "help()" : "help(\"" + topic + "\")";
    if (tokens.size() <= 2 && (tokens.front().is("who") || tokens.front().is("whos")) &&
        (tokens.size() == 1 || tokens.back().is(";")))
        return "who()";
    if (tokens.front().is("=")) return std::string(source).replace(tokens.front().begin, 1, " ");
    return std::nullopt;
}

bool is_leave(const Tokens& tokens) {
    if (!tokens.front().is("quit") && !tokens.front().is("exit")) return false;
    const auto bracket = [](const LuaToken& t) { return t.is("(") || t.is(")") || t.is(";"); };
    return std::all_of(tokens.begin() + 1, tokens.end(), bracket);
}

/// `source` is right as a chunk.
void keep_locals(PromptStatement& statement, const std::string& source, const Tokens& tokens) {
    const LocalsToAssignments rewritten(source, tokens);
    statement.code = rewritten.code();
    statement.variables = rewritten.names();
}

/// The code with `return` before a call that is its last statement; nothing where it ends in something else.
std::optional<std::string> with_last_call_returned(const std::string& code) {
    const Tokens tokens = lua_tokens(code);
    if (tokens.empty() ||
        !(tokens.back().is(")") || tokens.back().is("}") || tokens.back().kind == LuaToken::Kind::kString))
        return std::nullopt;
    for (std::size_t first = tokens.size(); first-- > 0;) {
        if (tokens[first].kind != LuaToken::Kind::kName || !begins_line(code, tokens, first)) continue;
        const std::string before = code.substr(0, tokens[first].begin), call = code.substr(tokens[first].begin);
        if (syntax_of("return " + call) != Syntax::kRight || syntax_of(before + "return " + call) != Syntax::kRight)
            continue;
        const bool shown_already = tokens[first].is("dynlab");
        return shown_already || syntax_of(call) != Syntax::kRight ? std::nullopt
                                                                  : std::optional(before + "return " + call);
    }
    return std::nullopt;
}

PromptStatement statement_of(const std::string& source, const std::string& code) {
    PromptStatement statement;
    statement.source = source;
    statement.code = code;
    statement.silent = true;
    statement.kind = PromptStatement::Kind::kReady;
    const Syntax syntax = syntax_of(code);
    if (syntax == Syntax::kRight) keep_locals(statement, code, lua_tokens(code));
    if (syntax == Syntax::kIncomplete) statement.kind = PromptStatement::Kind::kIncomplete;
    return statement;
}

}  // namespace

PromptStatement read_script_part(const std::string& source, const ShownCalls& shown) {
    return statement_of(source, with_shown_expressions(source, shown));
}

PromptStatement read_cell(const std::string& source, const ShownCalls& shown) {
    const std::string code = with_shown_expressions(source, shown);
    const std::optional<std::string> returned = with_last_call_returned(code);
    PromptStatement statement = statement_of(source, returned.value_or(code));
    statement.silent = !returned;
    return statement;
}

PromptStatement read_statement(const std::string& source, const ShownCalls& shown) {
    PromptStatement statement;
    statement.source = statement.code = source;
    const Tokens tokens = lua_tokens(statement.source);
    if (tokens.empty()) return statement;
    statement.kind = PromptStatement::Kind::kReady;
    statement.silent = tokens.back().is(";");
    if (is_leave(tokens)) {
        statement.kind = PromptStatement::Kind::kLeave;
        return statement;
    }
    const std::string expression = "return " + without_habit(source, tokens).value_or(source);
    const Syntax as_expression = syntax_of(expression);
    if (as_expression == Syntax::kRight) {
        const std::string named = with_shown_calls(source, shown);
        statement.code = named.starts_with("do ") ? named : expression;
        return statement;
    }
    const Syntax as_chunk = syntax_of(source);
    if (as_chunk == Syntax::kRight) {
        keep_locals(statement, source, tokens);
    } else if (as_chunk == Syntax::kIncomplete || as_expression == Syntax::kIncomplete) {
        statement.kind = PromptStatement::Kind::kIncomplete;
    }
    return statement;
}

}  // namespace dynlab::inline scripting
