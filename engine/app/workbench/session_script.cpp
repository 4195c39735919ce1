#include "app/workbench/session_script.h"

#include <re2/re2.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include "data_io/values/value_limits.h"
#include "documents/text_lines.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline app {
namespace {

using Tokens = std::span<const LuaToken>;
using Kind = LuaToken::Kind;

constexpr std::string_view kOff = "-- off: ";

bool opens(const LuaToken& token) {
    return token.is("(") || token.is("{") || token.is("[");
}
bool closes(const LuaToken& token) {
    return token.is(")") || token.is("}") || token.is("]");
}

/// How much deeper a script's blocks are behind a token: `for` and `while` have their `do`.
int block_change(const LuaToken& token) {
    if (token.is("function") || token.is("do") || token.is("if") || token.is("repeat")) return 1;
    if (token.is("end") || token.is("until")) return -1;
    return 0;
}

/// Whether a statement cannot end with this token, since more must come.
bool goes_on(const LuaToken& token) {
    if (token.kind == Kind::kSign) return !closes(token) && !token.is(";") && !token.is("::");
    return token.is("and") || token.is("or") || token.is("not") || token.is("local") || token.is("return");
}

/// Whether a statement can begin with this token.
bool begins(const LuaToken& token) {
    return token.kind == Kind::kName || token.is("::") ||
           (token.kind == Kind::kKeyword && !token.is("and") && !token.is("or") && !token.is("not"));
}

std::string text_of(std::string_view source, Tokens tokens) {
    if (tokens.empty()) return {};
    return replaced(std::string(source.substr(tokens.front().begin, tokens.back().end() - tokens.front().begin)), "\r",
                    "");
}

/// The parts between commas (and semicolons, in a table) outside of brackets.
std::vector<Tokens> parts_of(Tokens tokens) {
    std::vector<Tokens> parts;
    int depth = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        depth += opens(tokens[i]) + block_change(tokens[i]) - closes(tokens[i]);
        if (depth != 0 || !(tokens[i].is(",") || tokens[i].is(";"))) continue;
        parts.push_back(tokens.subspan(first, i - first));
        first = i + 1;
    }
    if (first < tokens.size()) parts.push_back(tokens.subspan(first));
    return parts;
}

/// Place of the bracket that closes the one at `from`.
std::optional<std::size_t> closing_of(Tokens tokens, std::size_t from) {
    int depth = 0;
    for (std::size_t i = from; i < tokens.size(); ++i) {
        depth += opens(tokens[i]) - closes(tokens[i]);
        if (depth == 0) return i;
    }
    return {};
}

/// The fields of a table in braces that has names for all of them.
std::optional<std::vector<StepOption>> options_in(std::string_view source, Tokens table) {
    if (table.size() < 2 || !table.front().is("{") || closing_of(table, 0) != table.size() - 1) return {};
    std::vector<StepOption> options;
    for (const Tokens field : parts_of(table.subspan(1, table.size() - 2))) {
        if (field.size() < 3 || field[0].kind != Kind::kName || !field[1].is("=")) return {};
        options.push_back({std::string(field[0].text), text_of(source, field.subspan(2))});
    }
    return options;
}

/// Reads `tokens` as one call and nothing more.
bool read_call(std::string_view source, Tokens tokens, SessionStep& step) {
    std::size_t i = 0;
    std::string name;
    while (i < tokens.size() && tokens[i].kind == Kind::kName) {
        name += tokens[i].text;
        if (++i == tokens.size()) return false;
        if (tokens[i].is(":") && step.receiver.empty())
            step.receiver = std::exchange(name, "");
        else if (tokens[i].is("."))
            name += ".";
        else
            break;
        ++i;
    }
    if (name.empty() || name.back() == '.') return false;
    step.function = name;
    if (tokens[i].kind == Kind::kString) {
        step.arguments = {std::string(tokens[i].text)};
        return i + 1 == tokens.size();
    }
    if (!(tokens[i].is("(") || tokens[i].is("{")) || closing_of(tokens, i) != tokens.size() - 1) return false;
    step.braces = tokens[i].is("{");
    if (step.braces) {
        const auto options = options_in(source, tokens.subspan(i));
        if (options) step.options = *options;
        return options.has_value();
    }
    std::vector<Tokens> arguments = parts_of(tokens.subspan(i + 1, tokens.size() - i - 2));
    if (!arguments.empty() && arguments.back().size() > 2)
        if (const auto options = options_in(source, arguments.back())) {
            step.options = *options;
            arguments.pop_back();
        }
    for (const Tokens argument : arguments) step.arguments.push_back(text_of(source, argument));
    return true;
}

bool has_remark_inside(std::string_view source, Tokens tokens) {
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        const std::string_view between = source.substr(tokens[i - 1].end(), tokens[i].begin - tokens[i - 1].end());
        if (between.find("--") != std::string_view::npos) return true;
    }
    return false;
}

std::optional<SessionStep> step_of(std::string_view source, Tokens tokens) {
    if (has_remark_inside(source, tokens)) return {};
    if (!tokens.empty() && tokens.back().is(";")) tokens = tokens.first(tokens.size() - 1);
    if (tokens.empty()) return {};
    SessionStep step;
    step.local = tokens[0].is("local");
    if (step.local) tokens = tokens.subspan(1);
    std::size_t i = 0;
    while (i + 1 < tokens.size() && tokens[i].kind == Kind::kName && tokens[i + 1].is(",")) i += 2;
    const bool gives = i + 2 < tokens.size() && tokens[i].kind == Kind::kName && tokens[i + 1].is("=");
    if (gives) {
        for (std::size_t k = 0; k <= i; k += 2) step.names.emplace_back(tokens[k].text);
        tokens = tokens.subspan(i + 2);
    } else if (step.local) {
        return {};
    }
    SessionStep called = step;
    if (read_call(source, tokens, called)) return called;
    if (!gives || parts_of(tokens).size() != 1) return {};
    step.arguments = {text_of(source, tokens)};
    return step;
}

/// Lines from 1 on at which offsets lie.
class Lines {
  public:
    explicit Lines(std::string_view source) {
        for (std::size_t i = 0; i < source.size(); ++i)
            if (source[i] == '\n') ends_.push_back(i);
    }
    int at(std::size_t offset) const {
        return 1 + static_cast<int>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
    }
    std::size_t begin_of(int line) const { return line == 1 ? 0 : ends_[static_cast<std::size_t>(line - 2)] + 1; }

  private:
    std::vector<std::size_t> ends_;
};

std::string_view without_blanks_before(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t\r\f\v"), text.size()));
}

/// The number of = signs between the opening brackets of a multi-line comment; nothing for other comments.
std::optional<std::size_t> level_of_remark(std::string_view remark) {
    if (!remark.starts_with("--[")) return {};
    const std::size_t second = std::min(remark.find_first_not_of('=', 3), remark.size());
    return second < remark.size() && remark[second] == '[' ? std::optional(second - 3) : std::nullopt;
}

/// Whether a statement is followed at most by a comment that ends with its line.
bool is_remark(const std::string& rest) {
    std::string_view left = without_blanks_before(rest);
    if (left.starts_with(';')) left = without_blanks_before(left.substr(1));
    return left.empty() || (left.starts_with("--") && !level_of_remark(left));
}

/// Whether a line begins as an assignment or a cell does, so that an unfinished statement cannot go on there.
bool begins_statement(const std::string& line) {
    static const RE2 kBegin(R"(^(-- %%|(local\s+)?[A-Za-z_]\w*(\s*,\s*[A-Za-z_]\w*)*\s*=[^=]))", RE2::Latin1);
    return RE2::PartialMatch(line, kBegin);
}

/// The first line of a statement that is no statement of Lua, with the lines behind it that can belong to it, where it
/// gives names to something.
std::optional<SessionStep> broken_step(const std::vector<std::string>& lines, int first) {
    static const RE2 kNames(R"((local\s+)?([A-Za-z_]\w*(?:\s*,\s*[A-Za-z_]\w*)*)\s*=)", RE2::Latin1),
        kName(R"((\w+))", RE2::Latin1);
    re2::StringPiece rest = lines[static_cast<std::size_t>(first - 1)], names;
    std::string local, name;
    if (!RE2::Consume(&rest, kNames, &local, &names)) return {};
    SessionStep step;
    step.broken = true;
    step.first_line = step.last_line = first;
    step.local = !local.empty();
    while (RE2::FindAndConsume(&names, kName, &name)) step.names.push_back(name);
    std::string text = trimmed(rest);
    for (int line = first + 1; line <= static_cast<int>(lines.size()); ++line) {
        const std::string& more = lines[static_cast<std::size_t>(line - 1)];
        if (is_blank(more) || begins_statement(more)) break;
        text += " " + trimmed(more);
        step.last_line = line;
    }
    step.arguments = {text};
    return step;
}

/// Whether tokens that look like one statement are none, or two of which the first is not finished.
bool is_unfinished(Tokens tokens, bool closed, const Lines& lines, const std::vector<std::string>& text) {
    const int first = lines.at(tokens.front().begin);
    int depth = 0;
    for (const LuaToken& token : tokens) {
        if (token.kind == Kind::kUnfinished) return true;
        depth += opens(token) + block_change(token) - closes(token);
        const int line = lines.at(token.begin);
        const bool second = depth == 0 && token.is("=") && line > first;
        if (second && begins_statement(text[static_cast<std::size_t>(line - 1)])) return true;
    }
    return !closed;
}

void add_running_steps(const std::string& source, std::vector<SessionStep>& steps) {
    const std::vector<LuaToken> all = lua_tokens(source);
    const std::vector<std::string> text = lines_of(source);
    const Lines lines(source);
    int blocks = 0, brackets = 0;
    for (std::size_t i = 0; i < all.size();) {
        const std::size_t first = i;
        const bool outside = blocks == 0;
        do {
            blocks = std::max(0, blocks + block_change(all[i]));
            brackets = std::max(0, brackets + opens(all[i]) - closes(all[i]));
            ++i;
        } while (i < all.size() && !(blocks == 0 && brackets == 0 && !goes_on(all[i - 1]) && begins(all[i]) &&
                                     lines.at(all[i].begin) > lines.at(all[i - 1].end() - 1)));
        const Tokens tokens = Tokens(all).subspan(first, i - first);
        if (outside && is_unfinished(tokens, blocks == 0 && brackets == 0 && !goes_on(tokens.back()), lines, text)) {
            if (auto broken = broken_step(text, lines.at(tokens.front().begin))) {
                for (i = first; i < all.size() && lines.at(all[i].begin) <= broken->last_line;) ++i;
                steps.push_back(*std::move(broken));
                blocks = brackets = 0;
                continue;
            }
        }
        if (!outside || blocks != 0 || brackets != 0) continue;
        std::optional<SessionStep> step = step_of(source, tokens);
        if (!step) continue;
        step->first_line = lines.at(all[first].begin);
        step->last_line = lines.at(all[i - 1].end() - 1);
        const std::size_t end = all[i - 1].end();
        step->rest = replaced(source.substr(end, source.find('\n', end) - end), "\r", "");
        const std::size_t begin = all[first].begin;
        const bool alone = is_blank(std::string_view(source).substr(lines.begin_of(step->first_line),
                                                                    begin - lines.begin_of(step->first_line)));
        if (alone && is_remark(step->rest)) steps.push_back(*std::move(step));
    }
}

/// The lines that begin inside a text or a remark of several lines.
std::set<int> lines_inside(const std::string& source) {
    const Lines lines(source);
    std::set<int> inside;
    const auto add = [&](std::size_t begin, std::size_t end) {
        for (int line = lines.at(begin) + 1; line <= lines.at(end - 1); ++line) inside.insert(line);
    };
    std::size_t next = 0;
    const auto add_remarks = [&](std::size_t end) {
        const std::string_view before = std::string_view(source).substr(0, end);
        for (std::size_t begin; (begin = before.find("--", next)) != std::string_view::npos;) {
            const auto level = level_of_remark(std::string_view(source).substr(begin));
            const std::string close = level ? "]" + std::string(*level, '=') + "]" : "\n";
            const std::size_t last = source.find(close, begin + (level ? *level + 4 : 0));
            next = last == std::string::npos ? source.size() : last + close.size();
            if (level) add(begin, next);
        }
        next = end;
    };
    for (const LuaToken& token : lua_tokens(source)) {
        add_remarks(token.begin);
        add(token.begin, token.end());
        next = token.end();
    }
    add_remarks(source.size());
    return inside;
}

void add_steps_switched_off(const std::string& source, std::vector<SessionStep>& steps) {
    const std::set<int> inside = lines_inside(source);
    int number = 0;
    for (const std::string& line : lines_of(source)) {
        ++number;
        if (!line.starts_with(kOff) || inside.contains(number)) continue;
        const std::string statement = line.substr(kOff.size());
        const std::vector<LuaToken> tokens = lua_tokens(statement);
        std::optional<SessionStep> step = step_of(statement, Tokens(tokens));
        if (!step) continue;
        step->first_line = step->last_line = number;
        step->on = false;
        step->rest = statement.substr(tokens.back().end());
        if (is_remark(step->rest)) steps.push_back(*std::move(step));
    }
}

}  // namespace

std::vector<SessionStep> session_steps(const std::string& source) {
    std::vector<SessionStep> steps;
    add_running_steps(source, steps);
    add_steps_switched_off(source, steps);
    std::ranges::stable_sort(steps, {}, &SessionStep::first_line);
    return steps;
}

std::string with_edits(const std::string& source, std::vector<LineEdit> edits) {
    std::vector<std::string> lines = lines_of(source);
    const int count = static_cast<int>(lines.size());
    std::ranges::stable_sort(edits, {}, &LineEdit::first);
    std::string text;
    int next = 1;  // line of the source that has not been seen to
    const auto copy_until = [&](int line) {
        for (; next < line; ++next) text += lines[static_cast<std::size_t>(next - 1)] + "\n";
    };
    for (const LineEdit& edit : edits) {
        if (edit.first < next || edit.first > count + 1 || edit.last > count || edit.last < edit.first - 1)
            throw ValueError("lines {} to {} do not exist in a script with {}", edit.first, edit.last,
                             plural(count, "{} line", "{} lines"));
        copy_until(edit.first);
        if (!edit.text.empty()) text += edit.text + "\n";
        next = edit.last + 1;
    }
    copy_until(count + 1);
    if (source.find("\r\n") == std::string::npos) return text;
    return replaced(replaced(text, "\r", ""), "\n", "\r\n");  // as its editor writes it
}

}  // namespace dynlab::inline app
