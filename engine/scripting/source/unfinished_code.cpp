#include "scripting/source/unfinished_code.h"

#include <algorithm>
#include <vector>

#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

/// Tokens one after the other, with their lines.
class LineCounter {
  public:
    explicit LineCounter(std::string_view source) : source_(source) {}
    int line_of(const LuaToken& token) {
        line_ += static_cast<int>(std::count(source_.begin() + at_, source_.begin() + place(token), '\n'));
        at_ = place(token);
        return line_;
    }

  private:
    static std::ptrdiff_t place(const LuaToken& token) { return static_cast<std::ptrdiff_t>(token.begin); }
    std::string_view source_;
    std::ptrdiff_t at_ = 0;
    int line_ = 1;
};

/// The number of white-space characters before a token on its line; nothing if there is other text.
std::optional<std::size_t> indent_of(std::string_view source, const LuaToken& token) {
    const std::size_t newline = token.begin == 0 ? std::string_view::npos : source.rfind('\n', token.begin - 1);
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const std::size_t first = source.find_first_not_of(" \t", begin);
    if (first != token.begin) return {};
    return first - begin;
}

bool is_any(const LuaToken& token, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return token.is(word); });
}

bool wants_more(const LuaToken& token) {
    return is_any(token, {"=",  ",",  "(",  "{", "[", "+",  "-",  "*",   "/",  "^",  "%",
                          "..", "==", "~=", "<", ">", "<=", ">=", "and", "or", "not"});
}

}  // namespace

std::optional<OpenBlock> block_without_end(std::string_view source) {
    struct Block {
        OpenBlock reported;
        std::size_t indent;  ///< of its line
    };
    std::vector<Block> open;
    LineCounter lines(source);
    OpenBlock loop;
    std::size_t indent = 0;
    int line_before = 0;
    bool behind_else = false;
    for (const LuaToken& token : lua_tokens(source)) {
        const int line = lines.line_of(token);
        const auto first = indent_of(source, token);
        if (line != line_before) indent = first.value_or(0);
        const bool else_if = behind_else && line == line_before && token.is("if");
        if (else_if && !open.empty() && open.back().reported.else_if == 0) open.back().reported.else_if = line;
        line_before = line;
        behind_else = token.is("else");
        if (is_any(token, {"for", "while"})) loop = {std::string(token.text), line, 0};
        if (token.is("do")) {
            open.push_back({loop.line > 0 ? loop : OpenBlock{"do", line, 0}, indent});
            loop = {};
        } else if (is_any(token, {"function", "if", "repeat"})) {
            open.push_back({{std::string(token.text), line, 0}, indent});
        } else if (is_any(token, {"end", "until"}) && !open.empty()) {
            if (token.is("end") && first && *first < open.back().indent) return open.back().reported;
            open.pop_back();
        }
    }
    if (open.empty()) return {};
    return open.back().reported;
}

std::optional<int> line_cut_off(std::string_view source, int line) {
    std::optional<LuaToken> last;
    int last_line = 0;
    LineCounter lines(source);
    for (const LuaToken& token : lua_tokens(source)) {
        const int at = lines.line_of(token);
        if (at >= line) break;
        last = token;
        last_line = at;
    }
    if (!last || !wants_more(*last)) return {};
    const std::vector<std::string> all = lines_of(source);
    for (int i = last_line + 1; i < line && i <= static_cast<int>(all.size()); ++i)
        if (is_cell_marker(all[static_cast<std::size_t>(i) - 1])) return last_line;
    return {};
}

}  // namespace dynlab::inline scripting
