#include "scripting/conversions/arguments.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <new>
#include <string_view>

#include "base/number_text.h"
#include "numerics/estimators/catalogue.h"
#include "platform/error.h"
#include "platform/interrupt.h"
#include "scripting/conversions/boxed.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/option_words.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kLargestExactWhole = 9007199254740992.0;  // 2^53

[[noreturn]] void wrong_value(lua_State* L, int index, const std::string& label, const std::string& wanted) {
    const bool mask = to_mask(L, index) != nullptr;
    const bool variables = wanted == "an iddata" && lua_istable(L, index);
    throw InvalidArgument(fmt::format("{} must be {}, but {} was given{}", label, wanted, given_text(L, index),
                                      mask        ? "; find(mask) gives the places, #find(mask) how many there are"
                                      : variables ? "; iddata(y, u, Ts) makes one of vectors"
                                                  : ""));
}

double number_at(lua_State* L, int index, const std::string& label) {
    if (lua_type(L, index) != LUA_TNUMBER) wrong_value(L, index, label, "a number");
    return lua_tonumber(L, index);
}

Index whole_at(lua_State* L, int index, const std::string& label) {
    const double value = number_at(L, index, label);
    if (std::floor(value) != value || std::abs(value) > kLargestExactWhole)
        throw InvalidArgument(fmt::format("{} must be a whole number, but {} was given", label, given_text(L, index)));
    return static_cast<Index>(value);
}

Index size_at(lua_State* L, int index, const std::string& label) {
    const Index value = whole_at(L, index, label);
    if (value < 0) throw InvalidArgument(fmt::format("{} must not be negative, but {} was given", label, value));
    return value;
}

std::string text_at(lua_State* L, int index, const std::string& label) {
    if (lua_type(L, index) != LUA_TSTRING) wrong_value(L, index, label, "a text in quotes");
    std::size_t length = 0;
    const char* text = lua_tolstring(L, index, &length);
    return {text, length};
}

VectorMap vector_at(lua_State* L, int index, const std::string& label) {
    index = lua_absindex(L, index);
    if (lua_type(L, index) == LUA_TTABLE) make_vector_of_table(L, index, label);
    if (lua_type(L, index) == LUA_TNUMBER) {
        push_vector(L, 1).data()[0] = lua_tonumber(L, index);
        lua_replace(L, index);
    }
    if (NumericBlock* block = to_vector(L, index)) return {block->data(), block->rows};
    if (NumericBlock* block = to_matrix(L, index); block != nullptr && block->columns == 1)
        return {block->data(), block->rows};
    wrong_value(L, index, label, "a vector");
}

std::string argument_label(int index, const char* what) {
    return fmt::format("argument {} ({})", index, what);
}

/// Behind a name and a colon a sentence goes on in small letters; names and symbols (Phi, A) keep theirs.
std::string going_on(std::string message) {
    for (const std::string_view word : {"All ", "At ", "Each ", "Irregular ", "The ", "With "})
        if (message.starts_with(word)) message.front() += 'a' - 'A';
    return message;
}

/// A failure with the called function's name before it, once. Where one method does the work of another, as lssvf
/// that of lsgpmf, the name is that of the one that was called.
std::string with_name(const std::string& name, const std::string& message) {
    const std::string first = message.substr(0, message.find_first_of(": "));
    if (first == name) return message;
    const bool of_method = message.compare(first.size(), 2, ": ") == 0 && find_method(first) && find_method(name);
    return name + ": " + going_on(of_method ? message.substr(first.size() + 2) : message);
}

/// Messages count the arguments of a method as the script writes them, without the object.
std::string of_called_method(lua_State* L, const char* name, std::string message) {
    constexpr std::string_view kArgument = "argument ";
    lua_Debug call;
    if (message.compare(0, kArgument.size(), kArgument) != 0 || !lua_getstack(L, 0, &call) ||
        !lua_getinfo(L, "n", &call) || call.namewhat == nullptr)
        return message;
    const std::string_view how = call.namewhat;
    std::size_t end = kArgument.size();
    while (end < message.size() && std::isdigit(static_cast<unsigned char>(message[end]))) ++end;
    if (end == kArgument.size() || end > kArgument.size() + 3) return message;
    const int number = std::stoi(message.substr(kArgument.size(), end - kArgument.size()));
    if (how == "method" && number > 1) return std::string(kArgument) + std::to_string(number - 1) + message.substr(end);
    if (how == "field" && number == 1 && name != nullptr && std::strchr(name, '.') == nullptr) {
        push_library(L);
        lua_pushstring(L, name);
        const bool is_function = lua_rawget(L, -2) != LUA_TNIL;
        lua_pop(L, 2);
        if (!is_function) message += fmt::format("; a method is called with a colon: object:{}(...)", name);
    }
    return message;
}

}  // namespace

std::string given_text(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TNONE:
            return "nothing";
        case LUA_TNIL:
            return "nil (no value)";
        case LUA_TNUMBER:
            return fmt::format("{:.10g}", lua_tonumber(L, index));
        case LUA_TSTRING:
            return fmt::format("the text \"{}\"", lua_tostring(L, index));
        case LUA_TBOOLEAN:
            return lua_toboolean(L, index) ? "true" : "false";
        case LUA_TUSERDATA:
            break;
        default:
            return article(luaL_typename(L, index));
    }
    if (NumericBlock* v = to_vector(L, index)) return "a vector of " + counted(v->rows, "value");
    if (NumericBlock* m = to_matrix(L, index)) return fmt::format("a {} x {} matrix", m->rows, m->columns);
    return article(object_name(L, index));
}

void wrong_argument(lua_State* L, int index, const char* what, const char* wanted) {
    if (index > lua_gettop(L))
        throw InvalidArgument(
            fmt::format("{} is missing; it must be {}", argument_label(index, what), article(wanted)));
    wrong_value(L, index, argument_label(index, what), article(wanted));
}

const char* Call::function_name() const {
    return static_cast<const char*>(lua_touserdata(state_, lua_upvalueindex(1)));
}

void Call::at_most(int arguments) const {
    if (arguments_ <= arguments) return;
    const bool orders = to_vector(state_, 1) == nullptr && lua_isuserdata(state_, 1) && arguments >= 2 &&
                        lua_type(state_, 2) == LUA_TNUMBER && lua_type(state_, 3) == LUA_TNUMBER;
    const bool named = arguments >= 1 && lua_type(state_, arguments) == LUA_TSTRING;
    const std::string options = fmt::format("{{{} = value}}", named ? lua_tostring(state_, arguments) : "name");
    throw InvalidArgument(fmt::format("takes at most {}, but {} were given; {} are written as one table {}",
                                      counted(arguments, "argument"), arguments_, orders ? "orders" : "options",
                                      orders ? "{1, 1, 0}" : options));
}

double Call::number(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "number");
    return number_at(state_, index, argument_label(index, what));
}
double Call::number_or(int index, const char* what, double fallback) const {
    return given(index) ? number(index, what) : fallback;
}
Index Call::integer(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "whole number");
    return whole_at(state_, index, argument_label(index, what));
}
Index Call::size(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "whole number");
    return size_at(state_, index, argument_label(index, what));
}
std::string Call::text(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "text in quotes");
    return text_at(state_, index, argument_label(index, what));
}

VectorMap Call::vector(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "vector");
    return vector_at(state_, index, argument_label(index, what));
}

MatrixMap Call::matrix(int index, const char* what) const {
    if (index > arguments_) wrong_argument(state_, index, what, "matrix");
    if (NumericBlock* block = to_matrix(state_, index)) return {block->data(), block->rows, block->columns};
    if (lua_type(state_, index) == LUA_TTABLE && lua_rawgeti(state_, index, 1) != LUA_TNUMBER) {
        lua_pop(state_, 1);
        make_matrix_of_table(state_, index, argument_label(index, what));
        NumericBlock* block = to_matrix(state_, index);
        return {block->data(), block->rows, block->columns};
    }
    lua_settop(state_, std::max(arguments_, index));
    const VectorMap column = vector(index, what);
    return {column.data(), column.size(), 1};
}

bool Call::holds_vector(int index) const {
    if (index > arguments_) return false;
    if (to_vector(state_, index) != nullptr) return true;
    if (type(index) != LUA_TTABLE) return false;
    const bool numbers = lua_rawgeti(state_, index, 1) == LUA_TNUMBER;
    lua_pop(state_, 1);
    return numbers;
}

std::function<bool()> Call::cancel() const {
    return [budget = context().budget] { return interrupted() || (budget && budget->reached() != TimeLimit::kNone); };
}

void Call::print(const std::string& text) const {
    RuntimeContext& context = this->context();
    if (context.recorder.printed_bytes() + text.size() > context.options.output_limit_bytes)
        raise_stop(state_, StopReason::kOutputLimit);
    context.recorder.print(text);
    if (context.printed_by_call) *context.printed_by_call += text;
    if (context.options.print) context.options.print(text);
}

void Call::print_lines(const std::string& text) const {
    const bool block = text.find('\n') < text.size() - 1;
    Recorder& recorder = context().recorder;
    print(block && recorder.ends_in_block() ? '\n' + text : text);
    if (block) recorder.note_block();
}

int Call::give(double value) const {
    return lua_pushnumber(state_, value), 1;
}
int Call::give_integer(Index value) const {
    return lua_pushinteger(state_, value), 1;
}
int Call::give(bool value) const {
    return lua_pushboolean(state_, value), 1;
}
int Call::give(const std::string& value) const {
    return lua_pushlstring(state_, value.data(), value.size()), 1;
}

int Call::give_vector(const VectorView& v) const {
    push_vector(state_, v.size()).vector() = v;
    return 1;
}
int Call::give_matrix(const MatrixView& m) const {
    push_matrix(state_, m.rows(), m.cols()).matrix() = m;
    return 1;
}

namespace {

/// The names of the options, for messages.
std::string names_of(std::initializer_list<const char*> known) {
    return known.size() == 0 ? "" : fmt::format("; the names are {}", fmt::join(known, ", "));
}

}  // namespace

Options::Options(const Call& call, int index, std::initializer_list<const char*> known)
    : call_(call), index_(lua_absindex(call.state(), index)) {
    lua_State* L = call.state();
    if (lua_isnoneornil(L, index_)) {
        index_ = 0;
        return;
    }
    if (lua_type(L, index_) != LUA_TTABLE)
        throw InvalidArgument(fmt::format("options are written as a table {{name = value}}, but {} was given{}",
                                          given_text(L, index_), names_of(known)));
    check_names(known);
}

void Options::check_names(std::initializer_list<const char*> known) const {
    lua_State* L = call_.state();
    lua_pushnil(L);
    while (lua_next(L, index_)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING)
            throw InvalidArgument(fmt::format("options are written {{name = value}}; the entry [{}] has no name{}",
                                              given_text(L, -1), names_of(known)));
        const std::string name = lua_tostring(L, -1);
        const auto is_known = [&](const std::string& word) { return std::ranges::find(known, word) != known.end(); };
        if (is_known(name)) continue;
        if (const std::string other = with_other_case(name); is_known(other)) {
            if (lua_getfield(L, index_, other.c_str()) != LUA_TNIL)
                throw InvalidArgument(fmt::format("options '{}' and '{}' are the same: give one of them", name, other));
            lua_pop(L, 1);
            continue;
        }
        throw InvalidArgument(unknown_option_sentence(name, {known.begin(), known.end()}));
    }
}

int Options::push(const char* name) const {
    lua_State* L = call_.state();
    luaL_checkstack(L, 4, "too many options");
    if (index_ == 0) {
        lua_pushnil(L);
    } else {
        lua_pushstring(L, name);
        if (lua_rawget(L, index_) == LUA_TNIL) {
            lua_pop(L, 1);
            lua_pushstring(L, with_other_case(name).c_str());
            lua_rawget(L, index_);
        }
    }
    return lua_gettop(L);
}

bool Options::has(const char* name) const {
    const int index = push(name);
    const bool found = !lua_isnil(call_.state(), index);
    lua_pop(call_.state(), 1);
    return found;
}

std::optional<double> Options::optional_number(const char* name) const {
    if (!has(name)) return std::nullopt;
    const double value = number_at(call_.state(), push(name), label(name));
    lua_pop(call_.state(), 1);
    return value;
}

double Options::number(const char* name, double fallback) const {
    return optional_number(name).value_or(fallback);
}

Index Options::size(const char* name, Index fallback) const {
    if (!has(name)) return fallback;
    const Index value = size_at(call_.state(), push(name), label(name));
    lua_pop(call_.state(), 1);
    return value;
}

bool Options::flag(const char* name, bool fallback) const {
    if (!has(name)) return fallback;
    const int index = push(name);
    if (!lua_isboolean(call_.state(), index)) wrong_value(call_.state(), index, label(name), "true or false");
    const bool value = lua_toboolean(call_.state(), index) != 0;
    lua_pop(call_.state(), 1);
    return value;
}

std::string Options::text(const char* name, const std::string& fallback) const {
    if (!has(name)) return fallback;
    std::string value = text_at(call_.state(), push(name), label(name));
    lua_pop(call_.state(), 1);
    return value;
}

std::vector<std::string> Options::texts(const char* name) const {
    lua_State* L = call_.state();
    const int index = push(name);
    std::vector<std::string> values;
    if (lua_type(L, index) == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, index, i) != LUA_TNIL; lua_pop(L, 1), ++i)
            values.push_back(text_at(L, -1, label(name)));
    } else if (!lua_isnil(L, index)) {
        values.push_back(text_at(L, index, label(name)));
    }
    lua_settop(L, index - 1);
    return values;
}

VectorMap Options::vector(const char* name) const {
    return vector_at(call_.state(), push(name), label(name));
}

std::map<std::string, double> Options::numbers_by_name(const char* name) const {
    lua_State* L = call_.state();
    const int index = push(name);
    std::map<std::string, double> values;
    if (!lua_isnil(L, index)) {
        if (lua_type(L, index) != LUA_TTABLE) wrong_value(L, index, label(name), "a table such as {a1 = 2}");
        for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -2) != LUA_TSTRING)
                throw InvalidArgument(fmt::format("{} must name its values, such as {{a1 = 2}}", label(name)));
            const std::string key = lua_tostring(L, -2);
            values[key] = number_at(L, -1, fmt::format("{} in {}", key, label(name)));
        }
    }
    lua_settop(L, index - 1);
    return values;
}

std::optional<std::pair<double, double>> Options::range(const char* name) const {
    if (!has(name)) return std::nullopt;
    const VectorMap bounds = vector(name);
    if (bounds.size() != 2)
        throw InvalidArgument(
            fmt::format("{} must be {{low, high}}, but it has {}", label(name), counted(bounds.size(), "value")));
    return std::pair(bounds[0], bounds[1]);
}

std::size_t Options::choice(const char* name, std::initializer_list<const char*> choices, std::size_t fallback) const {
    if (!has(name)) return fallback;
    const std::string given = text(name, "");
    const auto found = std::ranges::find(choices, given);
    if (found == choices.end())
        throw InvalidArgument(fmt::format("{} must be one of \"{}\", but \"{}\" was given", label(name),
                                          fmt::join(choices, "\", \""), given));
    return static_cast<std::size_t>(found - choices.begin());
}

int run_guarded(lua_State* L, Binding body) {
    poll_stop(L);  // a loop around long calls counts few instructions
    std::string message;
    try {
        context_of(L).recorder.note_time();
        Call call(L);
        return body(call);
    } catch (const Interrupted&) {
        message.clear();
    } catch (const std::bad_alloc&) {
        message = "there is not enough memory for this";
    } catch (const std::exception& error) {
        message = in_lua_words(error.what());
    }
    if (message.empty()) {
        poll_stop(L);  // of a limit, where it was one
        raise_stop(L, StopReason::kInterrupted);
    }
    const char* name = static_cast<const char*>(lua_touserdata(L, lua_upvalueindex(1)));
    message = of_called_method(L, name, std::move(message));
    raise_error(L, name == nullptr || name[0] == '_' ? message : with_name(name, message));
}

}  // namespace dynlab::inline scripting
