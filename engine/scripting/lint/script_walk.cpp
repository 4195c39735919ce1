#include "scripting/lint/script_walk.h"

#include <algorithm>
#include <optional>
#include <set>

#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

constexpr int kMaxDepth = 200;  // as deep as Lua itself reads
constexpr std::string_view kBinarySigns[] = {"+",  "-",  "*", "/",  "//", "^",  "%",  "&",  "~",   "|", ">>",
                                             "<<", "..", "<", "<=", ">",  ">=", "==", "~=", "and", "or"};

/// Reads tokens from first to last as Lua's grammar has them, and keeps the scopes of local variables.
class Walker {
  public:
    explicit Walker(std::string_view source)
        : tokens_(lua_tokens(source)), end_{LuaToken::Kind::kSign, "", source.size()} {}

    WalkedScript walk() {
        scopes_.emplace_back();
        while (!at_end()) {
            const std::size_t before = at_;
            statements();
            if (at_ == before) ++at_;  // an `end` too many
        }
        return std::move(walked_);
    }

  private:
    bool at_end() const { return at_ >= tokens_.size(); }
    const LuaToken& now() const { return at_end() ? end_ : tokens_[at_]; }
    const LuaToken& next() const { return at_ + 1 < tokens_.size() ? tokens_[at_ + 1] : end_; }
    bool is(std::string_view word) const { return !at_end() && now().is(word); }
    bool is_name() const { return !at_end() && now().kind == LuaToken::Kind::kName; }
    bool take(std::string_view word) {
        if (!is(word)) return false;
        ++at_;
        return true;
    }

    void declare(std::string_view name) {
        scopes_.back().insert(name);
        walked_.locals.emplace_back(name);
    }
    bool is_local(std::string_view name) const {
        return std::any_of(scopes_.begin(), scopes_.end(), [&](const auto& scope) { return scope.contains(name); });
    }

    void block() {
        scopes_.emplace_back();
        statements();
        scopes_.pop_back();
    }

    void statements() {
        while (!at_end() && !is("end") && !is("else") && !is("elseif") && !is("until")) {
            const std::size_t before = at_;
            statement();
            if (at_ == before) ++at_;
        }
    }

    void statement() {
        if (++depth_ < kMaxDepth) known_statement();
        --depth_;
    }

    void known_statement() {
        if (take("if")) return condition();
        if (take("while")) {
            expression();
            take("do");
            block();
            take("end");
        } else if (take("do")) {
            block();
            take("end");
        } else if (take("for")) {
            loop();
        } else if (take("repeat")) {
            scopes_.emplace_back();
            statements();
            if (take("until")) expression();
            scopes_.pop_back();
        } else if (take("function")) {
            named_function();
        } else if (take("local")) {
            local_statement();
        } else if (take("return")) {
            if (!at_end() && !is("end") && !is(";")) expressions();
        } else if (take("goto")) {
            ++at_;
        } else if (take("::")) {
            at_ += 2;
        } else if (!take(";") && !take("break")) {
            assignment_or_call();
        }
    }

    void condition() {
        expression();
        take("then");
        block();
        while (take("elseif")) {
            expression();
            take("then");
            block();
        }
        if (take("else")) block();
        take("end");
    }

    void loop() {
        const std::vector<std::string_view> names = name_list();
        if (take("=") || take("in")) expressions();
        take("do");
        scopes_.emplace_back();
        for (const std::string_view name : names) declare(name);
        statements();
        scopes_.pop_back();
        take("end");
    }

    /// Names with their attributes, as in `local x <const>, y`.
    std::vector<std::string_view> name_list() {
        std::vector<std::string_view> names;
        do {
            if (is_name()) names.push_back(tokens_[at_++].text);
            if (take("<")) at_ += 2;
        } while (take(","));
        return names;
    }

    void named_function() {
        if (!is_name()) return;
        const bool whole = !next().is(".") && !next().is(":");
        if (const auto use = global_use()) walked_.globals[*use].written = whole;
        bool method = false;
        while (is(".") || is(":")) {
            method = is(":");
            at_ += 2;
        }
        function_body(method);
    }

    void local_statement() {
        if (take("function")) {
            if (is_name()) declare(tokens_[at_++].text);
            return function_body(false);
        }
        const std::vector<std::string_view> names = name_list();
        if (take("=")) expressions();
        for (const std::string_view name : names) declare(name);
    }

    void function_body(bool method) {
        scopes_.emplace_back();
        if (method) declare("self");
        if (take("("))
            while (!at_end() && !take(")")) {
                if (is_name()) declare(now().text);
                ++at_;
            }
        statements();
        scopes_.pop_back();
        take("end");
    }

    void assignment_or_call() {
        std::vector<std::size_t> left = expressions();
        if (!take("=")) return;
        for (const std::size_t use : left) walked_.globals[use].written = true;
        expressions();
    }

    /// The places in `globals` of those expressions that are one name alone.
    std::vector<std::size_t> expressions() {
        std::vector<std::size_t> names;
        do {
            if (const auto use = expression()) names.push_back(*use);
        } while (take(","));
        return names;
    }

    std::optional<std::size_t> expression() {
        std::optional<std::size_t> name;
        if (++depth_ < kMaxDepth) name = operands();
        --depth_;
        return name;
    }

    std::optional<std::size_t> operands() {
        bool alone = true;
        std::optional<std::size_t> name;
        while (true) {
            while (take("not") || take("-") || take("#") || take("~")) alone = false;
            name = operand();
            const auto binary = [this](std::string_view sign) { return take(sign); };
            if (!std::any_of(std::begin(kBinarySigns), std::end(kBinarySigns), binary)) break;
            alone = false;
        }
        return alone ? name : std::nullopt;
    }

    std::optional<std::size_t> operand() {
        if (is("{")) {
            table();
        } else if (take("function")) {
            function_body(false);
        } else if (is_name() || is("(")) {
            return prefixed();
        } else if (!at_end() && (now().kind != LuaToken::Kind::kSign || is("..."))) {
            const bool value = now().kind != LuaToken::Kind::kKeyword || is("nil") || is("true") || is("false");
            if (value) ++at_;
        }
        return std::nullopt;
    }

    /// A name or bracket with all that follows it: fields, indices, calls.
    std::optional<std::size_t> prefixed() {
        std::string chain;
        const std::size_t begin = now().begin;
        std::optional<std::size_t> name;
        if (take("(")) {
            expression();
            take(")");
        } else {
            name = global_use();
            if (name) chain = walked_.globals[*name].name;
        }
        while (!at_end()) {
            if (is(".") && next().kind == LuaToken::Kind::kName) {
                if (name && walked_.globals[*name].member.empty()) {
                    walked_.globals[*name].member = next().text;
                    walked_.globals[*name].member_begin = next().begin;
                }
                if (!chain.empty()) chain += "." + std::string(next().text);
                at_ += 2;
            } else if (take("[")) {
                expression();
                take("]");
                chain.clear();
            } else if (is(":") && next().kind == LuaToken::Kind::kName) {
                at_ += 2;
                chain.clear();
                if (begins_arguments()) arguments();
            } else if (begins_arguments()) {
                WrittenCall call{chain, begin, arguments()};
                if (!chain.empty()) walked_.calls.push_back(std::move(call));
                chain.clear();
            } else {
                return name;
            }
            name.reset();
        }
        return name;
    }

    bool begins_arguments() const { return is("(") || is("{") || now().kind == LuaToken::Kind::kString; }

    std::vector<WrittenArgument> arguments() {
        std::vector<WrittenArgument> given;
        if (!take("(")) {
            given.push_back(argument());
            return given;
        }
        while (!at_end() && !is(")")) {
            const std::size_t before = at_;
            given.push_back(argument());
            take(",");
            if (at_ == before) break;
        }
        take(")");
        return given;
    }

    WrittenArgument argument() {
        WrittenArgument written;
        written.begin = now().begin;
        const bool alone = next().is(",") || next().is(")");
        if (is("{")) {
            written.kind = WrittenArgument::Kind::kTable;
            written.keys = table();
        } else if (now().kind == LuaToken::Kind::kString) {
            if (alone && now().text.front() != '[') {
                written.kind = WrittenArgument::Kind::kText;
                written.text = now().text.substr(1, now().text.size() - 2);
            }
            if (alone)
                ++at_;
            else
                expression();
        } else {
            expression();
        }
        return written;
    }

    std::vector<WrittenKey> table() {
        std::vector<WrittenKey> keys;
        take("{");
        while (!at_end() && !is("}")) {
            const std::size_t before = at_;
            if (take("[")) {
                expression();
                take("]");
                take("=");
            } else if (is_name() && next().is("=")) {
                keys.push_back({std::string(now().text), now().begin});
                at_ += 2;
            }
            expression();
            if (!take(",")) take(";");
            if (at_ == before) ++at_;
        }
        take("}");
        return keys;
    }

    /// Takes a name; its place in `globals`, nothing where it is a local variable.
    std::optional<std::size_t> global_use() {
        const LuaToken& token = tokens_[at_++];
        if (is_local(token.text)) return std::nullopt;
        walked_.globals.push_back({std::string(token.text), "", token.begin, 0, false});
        return walked_.globals.size() - 1;
    }

    std::vector<LuaToken> tokens_;
    LuaToken end_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::vector<std::set<std::string_view>> scopes_;
    WalkedScript walked_;
};

}  // namespace

WalkedScript walk_script(std::string_view source) {
    return Walker(source).walk();
}

}  // namespace dynlab::inline scripting
