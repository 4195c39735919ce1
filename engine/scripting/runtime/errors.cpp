#include "scripting/runtime/errors.h"
#include "documents/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

#include "scripting/runtime/context.h"
#include "scripting/runtime/matlab_hints.h"
#include "scripting/source/unfinished_code.h"

namespace dynlab::inline scripting {
namespace {

/// The text between `before` and `after`, if `text` has both.
std::optional<std::string> between(const std::string& text, std::string_view before, std::string_view after) {
    const auto start = text.find(before);
    if (start == std::string::npos) return std::nullopt;
    const auto from = start + before.size();
    const auto end = after.empty() ? text.size() : text.find(after, from);
    if (end == std::string::npos) return std::nullopt;
    return text.substr(from, end - from);
}

/// "(local 'x')" as words: "the variable 'x'"; "this value" when Lua names nothing.
std::string subject(const std::string& text) {
    for (const char* kind : {"local '", "global '", "upvalue '"})
        if (auto name = between(text, kind, "')")) return fmt::format("the variable '{}'", *name);
    if (auto name = between(text, "field '", "')"))
        return *name == "?" || *name == "integer index" ? "this element" : fmt::format("the field '{}'", *name);
    if (auto name = between(text, "method '", "')")) return fmt::format("the method '{}'", *name);
    if (auto name = between(text, "constant '", "')")) return fmt::format("the text '{}'", *name);
    return "this value";
}

std::string with_article(const std::string& type) {
    if (type == "nil") return "nil (it has no value)";
    if (type == "boolean") return "true or false";
    if (type == "string") return "a text";
    if (type == "userdata") return "an object";
    return article(type);
}

std::string call_sentence(const std::string& text, const std::string& type) {
    if (auto name = between(text, "method '", "')"))
        return fmt::format("there is no method '{}' on this object", *name);
    if (text.find("for iterator") != std::string::npos && type != "nil")
        return fmt::format("{} cannot be looped over so; write for i, x in ipairs(v) do ... end", with_article(type));
    if (type == "nil") return subject(text) + " is nil (it has no value), so it cannot be called like a function";
    const char* advice = type == "model"                       ? "; its values at frequencies are freqresp(G, w)"
                         : type == "matrix"                    ? "; the element i, j is written A[{i, j}]"
                         : type == "vector" || type == "table" ? "; the element i is written v[i]"
                                                               : "";
    return fmt::format("{} is {}, so it cannot be called like a function{}", subject(text), with_article(type), advice);
}

constexpr const char *kComplexNumber = "complex number", *kPartsOfComplex = "compare their fields re, im, abs or arg";

std::string compare_sentence(const std::string& text) {
    if (auto type = between(text, "attempt to compare two ", " values"))
        return fmt::format("two values of kind '{}' cannot be compared with < or >", *type);
    const auto left = between(text, "attempt to compare ", " with ");
    const auto right = between(text, " with ", "");
    if (left == kComplexNumber || right == kComplexNumber)
        return fmt::format("complex numbers have no order; {}", kPartsOfComplex);
    return fmt::format("{} cannot be compared with {} by < or >", with_article(left.value_or("this value")),
                       with_article(right.value_or("this value")));
}

/// Functions of Lua's math that have a namesake for vectors.
bool takes_vectors(const std::string& function) {
    for (const char* name : {"abs", "ceil", "cos", "exp", "floor", "log", "max", "min", "sin", "sqrt"})
        if (function == name) return true;
    return false;
}

/// bad argument #1 to 'insert' (table expected, got nil)
std::string argument_sentence(const std::string& text) {
    const auto number = between(text, "bad argument #", " to '");
    const auto function = between(text, " to '", "'");
    const auto reason = between(text, " (", "");
    if (!number || !function || !reason) return text;
    const std::string inside = reason->substr(0, reason->size() - 1);
    if (*function == "format" && inside.find("no integer representation") != std::string::npos)
        return fmt::format("format: argument {} is not a whole number, which %d wants; write %g or %.0f", *number);
    const std::string given = between(inside, " expected, got ", "").value_or("");
    if ((given == "vector" || given == "matrix") && takes_vectors(*function))
        return fmt::format("math.{0} takes numbers, but a {1} was given; write {0}(x), without math", *function, given);
    if (auto wanted = between(inside, "", " expected, got "))
        return fmt::format("{}: argument {} must be a {}, but {} was given", *function, *number, *wanted, given);
    return fmt::format("{}: argument {}: {}", *function, *number, inside);
}

constexpr const char *kLoopForm = "a loop is written: while condition do ... end",
                     *kConditionForm = "a condition is written: if a > b then ... end";
constexpr int kLinesBack = 5;  // from a syntax error to a comment that caused it

struct PlainMessage {
    std::string_view start;  ///< of Lua's message
    const char* sentence;
};

constexpr std::array kFixed = {
    PlainMessage{"stack overflow", "functions call each other without end (stack overflow)"},
    PlainMessage{"C stack overflow", "functions call each other without end (stack overflow)"},
    PlainMessage{"error in error handling", "an error happened while another error was being handled"},
    PlainMessage{"number has no integer representation", "a whole number is needed here"},
    PlainMessage{"attempt to divide by zero", "a whole number cannot be divided by zero with //"},
    PlainMessage{"attempt to perform 'n%0'", "the remainder of a division by zero does not exist"},
    PlainMessage{"'for' step is zero", "the step of a for loop must not be zero"},
    PlainMessage{"index is nil", "the key of the table is nil (it has no value)"},
    PlainMessage{"table index is nil", "the key of the table is nil (it has no value)"},
    PlainMessage{"table index is NaN", "the key of the table is not a number (NaN)"},
    PlainMessage{"table overflow", "the table has too many elements"},
    PlainMessage{"resulting string too large", "the text would be too long"},
    PlainMessage{"string length overflow", "the text would be too long"},
    PlainMessage{"cannot resume dead coroutine", "this coroutine has ended and cannot go on"},
    PlainMessage{"cannot resume non-suspended coroutine", "this coroutine is running already"},
    PlainMessage{"attempt to yield from outside a coroutine", "coroutine.yield works inside a coroutine only"},
    PlainMessage{"not enough memory", "the script needs more memory than it may use"},
};

bool starts_with(const std::string& text, std::string_view start) {
    return text.compare(0, start.size(), start) == 0;
}

std::string plain_sentence(const std::string& text) {
    if (auto type = between(text, "attempt to call a ", " value")) return call_sentence(text, *type);
    if (auto type = between(text, "attempt to index a ", " value"))
        return fmt::format("{} is {}, so it has no fields or elements{}", subject(text), with_article(*type),
                           *type == "number" && text.find("integer index") != std::string::npos
                               ? "; the element i, j of a matrix is A[{i, j}]"
                               : "");
    if (auto type = between(text, "attempt to perform arithmetic on a ", " value")) {
        const char* advice = *type == "table"          ? "; make a vector of it: vector(t)"
                             : *type == kComplexNumber ? "; calculate with its fields re, im, abs and arg"
                                                       : "";
        return fmt::format("{} is {}, so it cannot be calculated with{}", subject(text), with_article(*type), advice);
    }
    if (auto type = between(text, "attempt to perform bitwise operation on a ", " value"))
        return fmt::format("{} is {}, so & | ~ << >> cannot work with it{}", subject(text), with_article(*type),
                           *type == "boolean" ? "; 'not' is written not x" : "");
    if (auto type = between(text, "attempt to concatenate a ", " value"))
        return fmt::format("{} is {}, so .. cannot join it to a text; use tostring(x)", subject(text),
                           with_article(*type));
    if (auto type = between(text, "attempt to get length of a ", " value"))
        return fmt::format("{} is {}, so # cannot count its elements{}", subject(text), with_article(*type),
                           *type == "iddata" ? "; data.N is the number of samples" : "");
    if (text.find(" a 'string' with a ") != std::string::npos)
        return "a text cannot be calculated with; two dots join texts and numbers: \"a = \" .. x";
    if (starts_with(text, "attempt to compare ")) return compare_sentence(text);
    if (starts_with(text, "bad argument #")) return argument_sentence(text);
    if (auto part = between(text, "bad 'for' ", " (number expected, got "))
        return fmt::format("the {} of a for loop must be a number, but {} was given", *part,
                           with_article(*between(text, "expected, got ", ")")));
    for (const PlainMessage& fixed : kFixed)
        if (starts_with(text, fixed.start)) return fixed.sentence;
    return text;
}

std::string syntax_sentence(const std::string& text, const std::string& near) {
    if (auto opened = between(text, "'end' expected (to close '", "' at line "))
        return fmt::format("the '{}' of line {} has no 'end'", *opened, *between(text, "at line ", ")"));
    if (auto closing = between(text, "", " expected (to close '"))
        return fmt::format("the '{}' of line {} is not closed: {} is missing",
                           *between(text, "(to close '", "' at line "), *between(text, "at line ", ")"), *closing);
    if (auto name = between(text, "attempt to assign to const variable '", "'"))
        return fmt::format("'{}' was declared constant and cannot change", *name);
    if (auto line = between(text, "break outside loop at line ", ""))
        return fmt::format("the break of line {} stands outside of any loop", line->substr(0, line->find(' ')));
    if (auto most = between(text, "too many local variables (limit is ", ")"))
        return fmt::format(
            "here can be at most {} local variables; declare further ones without 'local', or keep them in a table",
            *most);
    if (text.find("unfinished string") != std::string::npos) return "a text is not closed with its quote";
    if (near == "<eof>") return "the script ends in the middle of a statement";
    if (starts_with(text, "<eof> expected") && near != "end")
        return fmt::format("'{}' cannot follow: return ends its block; -- before it takes it out", near);
    if (starts_with(text, "<eof> expected"))
        return fmt::format("this '{}' closes nothing: there is one too many", near);
    if (starts_with(text, "<name> expected")) return fmt::format("a name is missing before '{}'", near);
    if (auto wanted = between(text, "", " expected")) return fmt::format("{} is missing before '{}'", *wanted, near);
    if (!near.empty()) return fmt::format("'{}' cannot stand here", near);
    return text;
}

/// Lua finds out at the end of the script; the reader looks where the block begins.
LocatedMessage missing_end(const LocatedMessage& placed, const std::string& source) {
    const auto block = block_without_end(source);
    if (!block) return {placed.file, placed.line, "an 'end' is missing at the end of the script"};
    if (block->else_if > 0)
        return {placed.file, block->else_if, "an 'end' is missing: 'else if' opens a second block; write elseif"};
    return {placed.file, block->line, fmt::format("the '{}' of line {} has no 'end'", block->word, block->line)};
}

/// Plain words for what Lua says at run time, location kept ("attempt to index a nil value (local 'x')" and its like).
std::string plain_runtime_message(const std::string& message) {
    LocatedMessage placed = take_apart(message);
    placed.text = plain_sentence(placed.text);
    return placed.joined();
}

}  // namespace

std::string article(const std::string& noun) {
    const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
    return (vowel ? "an " : "a ") + noun;
}

std::string line_of(const std::string& source, int line) {
    std::size_t start = 0;
    for (int i = 1; i < line && start != std::string::npos; ++i) {
        start = source.find('\n', start);
        if (start != std::string::npos) ++start;
    }
    if (start == std::string::npos) return {};
    return source.substr(start, source.find('\n', start) - start);
}

std::string LocatedMessage::joined() const {
    return line > 0 ? fmt::format("{}:{}: {}", file, line, text) : text;
}

LocatedMessage take_apart(const std::string& message) {
    for (auto colon = message.find(':'); colon != std::string::npos; colon = message.find(':', colon + 1)) {
        auto end = colon + 1;
        while (end < message.size() && std::isdigit(static_cast<unsigned char>(message[end]))) ++end;
        if (end > colon + 1 && end < colon + 10 && message.compare(end, 2, ": ") == 0)
            return {message.substr(0, colon), std::stoi(message.substr(colon + 1, end - colon - 1)),
                    message.substr(end + 2)};
        if (message.find_first_of("'\"") < colon) break;
    }
    return {"", 0, message};
}

std::string plain_syntax_message(const std::string& message, const std::string& source) {
    LocatedMessage placed = take_apart(message);
    if (placed.text.find("attempt to load a binary chunk") != std::string::npos)
        return "this is not Lua text but a compiled chunk, which is not accepted";
    std::string near = between(placed.text, " near '", "").value_or("");
    if (!near.empty()) near.pop_back();
    if (placed.text.find(" near <eof>") != std::string::npos) near = "<eof>";
    // A comment of another language may end a statement before it, or look like a part of it.
    for (int line = placed.line; line > 0 && line > placed.line - kLinesBack; --line) {
        if (begins_foreign_comment(line_of(source, line)))
            return LocatedMessage{placed.file, line, "a comment starts with -- in Lua"}.joined();
        if (const std::string hint = lone_word_hint(line_of(source, line)); !hint.empty())
            return LocatedMessage{placed.file, line, hint}.joined();
    }
    if (const auto line = line_cut_off(source, placed.line); line && near != "end") {
        return LocatedMessage{placed.file, *line, "this statement goes on, but the cell ends here"}.joined();
    }
    if (near == "<eof>") {
        int line = 0;
        for (const std::string& text : lines_of(source)) {
            ++line;
            if (const std::string hint = colon_block_hint(text); !hint.empty())
                return LocatedMessage{placed.file, line, hint}.joined();
        }
        if (placed.text.find("'end' expected") != std::string::npos) return missing_end(placed, source).joined();
        if (const auto opened = between(placed.text, "' at line ", ")")) placed.line = std::stoi(*opened);
    }
    const std::string wrong = line_of(source, placed.line);
    if (starts_with(near, "<\\"))
        if (const auto sentence = foreign_character_sentence(wrong))
            return LocatedMessage{placed.file, placed.line, *sentence}.joined();
    const bool ended_early = near == "<eof>" && placed.text.find("unfinished string") == std::string::npos;
    std::string hint = ended_early ? "" : matlab_syntax_hint(wrong, near);
    if (hint.empty() && starts_with(placed.text, "'do' expected")) hint = kLoopForm;
    if (hint.empty() && starts_with(placed.text, "'then' expected")) hint = kConditionForm;
    placed.text = syntax_sentence(placed.text, near);
    if (!hint.empty()) placed.text += "; " + hint;
    return placed.joined();
}

void translate_value_on_top(lua_State* L) {
    if (lua_type(L, -1) != LUA_TSTRING) return;
    const std::string plain = plain_runtime_message(lua_tostring(L, -1));
    lua_pop(L, 1);
    lua_pushlstring(L, plain.data(), plain.size());
}

int translate_error(lua_State* L) {
    lua_settop(L, 1);
    if (lua_type(L, 1) == LUA_TSTRING && take_apart(lua_tostring(L, 1)).line == 0) {
        const std::string location = script_location(L);  // errors without a location, such as a stack overflow in C
        if (!location.empty()) {
            lua_pushfstring(L, "%s: %s", location.c_str(), lua_tostring(L, 1));
            lua_replace(L, 1);
        }
    }
    translate_value_on_top(L);
    return 1;
}

std::string memory_message(const RuntimeContext& context) {
    const std::string text = fmt::format("the script needs more memory than the {} it may use",
                                         size_text(static_cast<double>(context.memory.limit())));
    return LocatedMessage{context.script_name, context.refusal_line, text}.joined();
}

void push_memory_message(lua_State* L) {
    const std::string text = memory_message(context_of(L));
    lua_pop(L, 1);
    lua_pushlstring(L, text.data(), text.size());
}

}  // namespace dynlab::inline scripting
