#include "scripting/runtime/errors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "documents/text_lines.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/kind_phrases.h"
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
Message subject(const std::string& text) {
    for (const char* kind : {"local '", "global '", "upvalue '"})
        if (auto name = between(text, kind, "')")) return Message("the variable '{}'", *name);
    if (auto name = between(text, "field '", "')"))
        return *name == "?" || *name == "integer index" ? Message("this element") : Message("the field '{}'", *name);
    if (auto name = between(text, "method '", "')")) return Message("the method '{}'", *name);
    if (auto name = between(text, "constant '", "')")) return Message("the string '{}'", *name);
    return Message("this value");
}

/// With what to write instead behind it, where there is something.
Message with_advice(const Message& sentence, const Message& advice) {
    return advice.empty() ? sentence : Message("{}; {}", sentence, advice);
}

Message call_sentence(const std::string& text, const std::string& type) {
    if (auto name = between(text, "method '", "')")) return Message("the object has no method '{}'", *name);
    if (text.find("for iterator") != std::string::npos && type != "nil")
        return Message("{} does not support this loop; write for i, x in ipairs(v) do ... end", what_it_is(type));
    if (type == "nil")
        return Message("{} is nil (it has no value), so it cannot be called like a function", subject(text));
    const Message advice = type == "model"
                               ? Message("freqresp(G, w) returns the values of a model G at the frequencies w")
                           : type == "matrix"                    ? Message("write the element i, j as A[{i, j}]")
                           : type == "vector" || type == "table" ? Message("write the element i as v[i]")
                                                                 : Message();
    return with_advice(Message("{} is {}, so it cannot be called like a function", subject(text), what_it_is(type)),
                       advice);
}

constexpr const char* kComplexNumber = "complex number";

Message kind_or_value(const std::optional<std::string>& type) {
    return type ? what_it_is(*type) : Message("this value");
}

Message compare_sentence(const std::string& text) {
    const auto both = between(text, "attempt to compare two ", " values");
    const auto left = both ? both : between(text, "attempt to compare ", " with ");
    const auto right = both ? both : between(text, " with ", "");
    if (left == kComplexNumber || right == kComplexNumber)
        return Message("complex numbers have no order; compare their fields re, im, abs or arg");
    return Message("{} cannot be compared with {} by < or >", kind_or_value(left), kind_or_value(right));
}

/// Functions of Lua's math that have a namesake for vectors.
bool takes_vectors(const std::string& function) {
    for (const char* name : {"abs", "ceil", "cos", "exp", "floor", "log", "max", "min", "sin", "sqrt"})
        if (function == name) return true;
    return false;
}

/// bad argument #1 to 'insert' (table expected, got nil)
Message argument_sentence(const std::string& text) {
    const auto number = between(text, "bad argument #", " to '");
    const auto function = between(text, " to '", "'");
    const auto reason = between(text, " (", "");
    if (!number || !function || !reason) return {};
    const std::string inside = reason->substr(0, reason->size() - 1);
    if (*function == "format" && inside.find("no integer representation") != std::string::npos)
        return Message("{}: {}", *function,
                       Message("argument {} is not a whole number, which %d requires; write %g or %.0f", *number));
    const std::string given = between(inside, " expected, got ", "").value_or("");
    if ((given == "vector" || given == "matrix") && takes_vectors(*function))
        return Message("math.{} requires numbers, but {} was given; write {}(x), without math", *function,
                       with_article(given), *function);
    if (auto requested = between(inside, "", " expected, got "))
        return Message("{}: {}", *function,
                       Message("argument {} must be {}, but {} was given", *number, with_article(*requested),
                               given == "no value" ? Message("no value") : what_it_is(given)));
    if (inside == "number has no integer representation")
        return Message("{}: argument {}: {}", *function, *number,
                       Message("a whole number is required; round the number, for example with floor(x)"));
    return Message("{}: argument {}: {}", *function, *number, inside);
}

constexpr int kLinesBack = 5;  // from a syntax error to a comment that caused it

struct PlainMessage {
    std::string_view start;  ///< of Lua's message
    Message sentence;
};

const auto& fixed_messages() {
    static const std::array messages = {
        PlainMessage{"stack overflow", Message("infinite recursion (stack overflow): a function calls itself, directly "
                                               "or through other functions, and never stops")},
        PlainMessage{"C stack overflow", Message("infinite recursion (stack overflow): a function calls itself, "
                                                 "directly or through other functions, and never stops")},
        PlainMessage{"error in error handling", Message("an error occurred while another error was handled")},
        PlainMessage{"number has no integer representation",
                     Message("a whole number is required; round the number, for example with floor(x)")},
        PlainMessage{"attempt to divide by zero", Message("a whole number cannot be divided by zero with //")},
        PlainMessage{"attempt to perform 'n%0'", Message("the remainder of a division by zero is undefined")},
        PlainMessage{"'for' step is zero", Message("the step of a for loop must not be zero")},
        PlainMessage{"index is nil",
                     Message("a key of a table must not be nil (no value); check the expression in the brackets")},
        PlainMessage{"table index is nil",
                     Message("a key of a table must not be nil (no value); check the expression in the brackets")},
        PlainMessage{"table index is NaN",
                     Message("a key of a table must not be NaN (not a number); check the expression in the brackets")},
        PlainMessage{"table overflow", Message("the table has too many elements")},
        PlainMessage{"resulting string too large", Message("the string would be too long")},
        PlainMessage{"string length overflow", Message("the string would be too long")},
        PlainMessage{"cannot resume dead coroutine", Message("this coroutine has ended and cannot be resumed")},
        PlainMessage{"cannot resume non-suspended coroutine", Message("this coroutine is already running")},
        PlainMessage{"attempt to yield from outside a coroutine",
                     Message("coroutine.yield works only inside a coroutine")},
        PlainMessage{"not enough memory", Message("the script needs more memory than allowed")},
    };
    return messages;
}

bool starts_with(const std::string& text, std::string_view start) {
    return text.compare(0, start.size(), start) == 0;
}

/// Empty for what is none of Lua's own messages.
Message plain_sentence(const std::string& text) {
    if (auto type = between(text, "attempt to call a ", " value")) return call_sentence(text, *type);
    if (auto type = between(text, "attempt to index a ", " value"))
        return with_advice(Message("{} is {}, so it has no fields or elements", subject(text), what_it_is(*type)),
                           *type == "number" && text.find("integer index") != std::string::npos
                               ? Message("the element i, j of a matrix is A[{i, j}]")
                               : Message());
    if (auto type = between(text, "attempt to perform arithmetic on a ", " value"))
        return with_advice(Message("{} is {}, so arithmetic with it is not possible", subject(text), what_it_is(*type)),
                           *type == "table"          ? Message("convert the table to a vector: vector(t)")
                           : *type == kComplexNumber ? Message("use its fields re, im, abs and arg")
                                                     : Message());
    if (auto type = between(text, "attempt to perform bitwise operation on a ", " value"))
        return with_advice(
            Message("{} is {}, so the operators & | ~ << >> do not support it", subject(text), what_it_is(*type)),
            *type == "boolean" ? Message("for logical values, use the operators not, and, or: not x, x and y, x or y")
                               : Message());
    if (auto type = between(text, "attempt to concatenate a ", " value"))
        return Message("{} is {}, so the operator .. cannot join it to a string; use tostring(x)", subject(text),
                       what_it_is(*type));
    if (auto type = between(text, "attempt to get length of a ", " value"))
        return with_advice(
            Message("{} is {}, so the operator # cannot count its elements", subject(text), what_it_is(*type)),
            *type == "iddata" ? Message("data.N is the number of samples") : Message());
    if (starts_with(text, "attempt to mod a 'string'"))
        return Message("arithmetic with a string is not possible; to format numbers, write string.format(\"%.3f\", x)");
    if (text.find(" a 'string' with a ") != std::string::npos)
        return Message(
            "arithmetic with a string is not possible; use two dots to join strings and numbers: \"a = \" .. x");
    if (starts_with(text, "attempt to compare ")) return compare_sentence(text);
    if (starts_with(text, "bad argument #")) return argument_sentence(text);
    if (auto part = between(text, "bad 'for' ", " (number expected, got "))
        return Message("the {} of a for loop must be a number, but {} was given",
                       *part == "initial value" ? Message("initial value")
                       : *part == "limit"       ? Message("limit")
                                                : Message("step"),
                       what_it_is(*between(text, "expected, got ", ")")));
    for (const PlainMessage& fixed : fixed_messages())
        if (starts_with(text, fixed.start)) return fixed.sentence;
    return {};
}

Message syntax_sentence(const std::string& text, const std::string& near) {
    if (auto opened = between(text, "'end' expected (to close '", "' at line "))
        return Message("the '{}' in line {} has no 'end'", *opened, *between(text, "at line ", ")"));
    if (auto closing = between(text, "", " expected (to close '"))
        return Message("the '{}' in line {} is not closed: {} is missing", *between(text, "(to close '", "' at line "),
                       *between(text, "at line ", ")"), *closing);
    if (auto name = between(text, "attempt to assign to const variable '", "'"))
        return Message("'{}' is a constant and cannot be changed", *name);
    if (auto line = between(text, "break outside loop at line ", ""))
        return Message("the 'break' in line {} is outside a loop", line->substr(0, line->find(' ')));
    if (auto max_locals = between(text, "too many local variables (limit is ", ")"))
        return Message(
            "a function can have at most {} local variables; declare further variables without 'local', or put them in "
            "a table",
            *max_locals);
    if (text.find("unfinished string") != std::string::npos)
        return Message("the string is not closed by a quotation mark");
    if (near == "<eof>") return Message("the script ends in the middle of a statement");
    const bool closes = near == "end" || near == "else" || near == "elseif" || near == "until";
    if (starts_with(text, "<eof> expected") && !closes)
        return Message(
            "unexpected '{}': return must be the last statement of its block. Remove return, or comment out the "
            "statements after it with --",
            near);
    if (starts_with(text, "<eof> expected")) return Message("unexpected '{}': no block is open", near);
    if (starts_with(text, "<name> expected")) return Message("expected a name before '{}'", near);
    if (auto requested = between(text, "", " expected")) return Message("expected {} before '{}'", *requested, near);
    if (!near.empty()) return Message("unexpected '{}'", near);
    return Message::verbatim(text);
}

/// Lua finds out at the end of the script; the reader looks where the block begins.
PlacedMessage missing_end(const LocatedMessage& placed, const std::string& source) {
    const auto block = block_without_end(source);
    if (!block) return {Message("an 'end' is missing at the end of the script"), placed.file, placed.line};
    if (block->else_if > 0)
        return {Message("an 'end' is missing, because 'else if' opens a second block; write elseif"), placed.file,
                block->else_if};
    return {Message("the '{}' in line {} has no 'end'", block->word, block->line), placed.file, block->line};
}

}  // namespace

std::string line_of(const std::string& source, int line) {
    std::size_t start = 0;
    for (int i = 1; i < line && start != std::string::npos; ++i) {
        start = source.find('\n', start);
        if (start != std::string::npos) ++start;
    }
    if (start == std::string::npos) return {};
    return source.substr(start, source.find('\n', start) - start);
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

PlacedMessage syntax_error(const std::string& message, const std::string& source) {
    LocatedMessage placed = take_apart(message);
    const auto at = [&](int line, Message text) { return PlacedMessage{std::move(text), placed.file, line}; };
    if (placed.text.find("attempt to load a binary chunk") != std::string::npos)
        return {Message("this is a compiled Lua chunk, which dynlab does not accept; use the source text")};
    std::string near = between(placed.text, " near '", "").value_or("");
    if (!near.empty()) near.pop_back();
    if (placed.text.find(" near <eof>") != std::string::npos) near = "<eof>";
    // A comment of another language may end a statement before it, or look like a part of it.
    for (int line = placed.line; line > 0 && line > placed.line - kLinesBack; --line) {
        if (begins_foreign_comment(line_of(source, line))) return at(line, Message("a comment starts with -- in Lua"));
        if (Message hint = lone_word_hint(line_of(source, line)); !hint.empty()) return at(line, std::move(hint));
    }
    if (const auto line = line_cut_off(source, placed.line); line && near != "end")
        return at(*line, Message("the statement is incomplete at the end of the cell"));
    if (near == "<eof>") {
        int line = 0;
        for (const std::string& text : lines_of(source)) {
            ++line;
            if (Message hint = colon_block_hint(text); !hint.empty()) return at(line, std::move(hint));
        }
        if (placed.text.find("'end' expected") != std::string::npos) return missing_end(placed, source);
        if (const auto opened = between(placed.text, "' at line ", ")")) placed.line = std::stoi(*opened);
    }
    const std::string wrong = line_of(source, placed.line);
    if (starts_with(near, "<\\"))
        if (Message sentence = foreign_character_sentence(wrong); !sentence.empty())
            return at(placed.line, std::move(sentence));
    const bool ended_early = near == "<eof>" && placed.text.find("unfinished string") == std::string::npos;
    Message hint = ended_early ? Message() : matlab_syntax_hint(wrong, near);
    if (hint.empty() && starts_with(placed.text, "'do' expected"))
        hint = Message("write a loop in the form: while condition do ... end");
    if (hint.empty() && starts_with(placed.text, "'then' expected"))
        hint = Message("write a condition in the form: if a > b then ... end");
    return at(placed.line, with_advice(syntax_sentence(placed.text, near), hint));
}

PlacedMessage error_at(lua_State* L, int index) {
    const bool is_text = lua_type(L, index) == LUA_TSTRING;
    std::size_t length = 0;
    const char* const text = is_text ? lua_tolstring(L, index, &length) : luaL_tolstring(L, index, &length);
    const std::string said(text, length);
    if (!is_text) lua_pop(L, 1);
    const RaisedError& raised = context_of(L).raised;
    if (is_text && said == raised.text) return raised.error;
    LocatedMessage placed = take_apart(said);
    return {Message::verbatim(std::move(placed.text)), std::move(placed.file), placed.line};
}

void translate_value_on_top(lua_State* L) {
    if (lua_type(L, -1) != LUA_TSTRING || lua_tostring(L, -1) == context_of(L).raised.text) return;
    const LocatedMessage placed = take_apart(lua_tostring(L, -1));
    const Message plain = plain_sentence(placed.text);
    if (plain.empty()) return;
    lua_pop(L, 1);
    push_error(L, {plain, placed.file, placed.line});
}

int translate_error(lua_State* L) {
    lua_settop(L, 1);
    if (lua_type(L, 1) == LUA_TSTRING && lua_tostring(L, 1) == context_of(L).raised.text) return 1;
    if (lua_type(L, 1) == LUA_TSTRING && take_apart(lua_tostring(L, 1)).line == 0) {
        const ScriptPlace place = script_place(L);  // errors without a location, such as a stack overflow in C
        if (place.line > 0) {
            lua_pushfstring(L, "%s:%d: %s", place.file.c_str(), place.line, lua_tostring(L, 1));
            lua_replace(L, 1);
        }
    }
    translate_value_on_top(L);
    return 1;
}

PlacedMessage memory_error(const RuntimeContext& context) {
    return {Message("the script needs more memory than the limit of {}",
                    size_phrase(static_cast<double>(context.memory.limit()))),
            context.script_name, context.refusal_line};
}

void push_memory_error(lua_State* L) {
    lua_pop(L, 1);
    push_error(L, memory_error(context_of(L)));
}

}  // namespace dynlab::inline scripting
