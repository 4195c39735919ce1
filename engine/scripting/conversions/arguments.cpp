#include "scripting/conversions/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "platform/interrupt.h"
#include "scripting/conversions/misplaced_argument.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/option_words.h"
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/kind_phrases.h"

namespace dynlab::inline scripting {
namespace {

auto label_of(const char* option) {
    return [option] { return option_label(option); };
}

constexpr double kLargestExactWhole = 9007199254740992.0;  // 2^53

[[noreturn]] void wrong_value(lua_State* L, int index, const Message& label, const Message& requested) {
    const Message given = given_value(L, index);
    refuse_misplaced(L, index, label, requested, given);
    if (to_mask(L, index) != nullptr)
        throw InvalidArgument(
            "{} must be {}, but {} was given; find(mask) returns the indices, and #find(mask) returns their number",
            label, requested, given);
    if (requested == with_article("iddata") && lua_istable(L, index))
        throw InvalidArgument(
            "{} must be {}, but {} was given; create a data object from vectors with iddata(y, u, Ts)", label,
            requested, given);
    throw InvalidArgument("{} must be {}, but {} was given", label, requested, given);
}

// Labels are functions that make them: few of the values that are read are wrong.

template <class Label>
double number_at(lua_State* L, int index, const Label& label) {
    if (lua_type(L, index) != LUA_TNUMBER) wrong_value(L, index, label(), Message("a number"));
    return lua_tonumber(L, index);
}

template <class Label>
std::int64_t whole_at(lua_State* L, int index, const Label& label) {
    const double value = number_at(L, index, label);
    if (std::floor(value) != value || std::abs(value) > kLargestExactWhole)
        wrong_value(L, index, label(), Message("a whole number"));
    return static_cast<std::int64_t>(value);
}

/// From 0 on.
template <class Label>
std::int64_t count_at(lua_State* L, int index, const Label& label) {
    const std::int64_t value = whole_at(L, index, label);
    if (value < 0) throw InvalidArgument("{} must be nonnegative, but {} was given", label(), value);
    return value;
}

template <class Label>
std::string text_at(lua_State* L, int index, const Label& label) {
    if (lua_type(L, index) != LUA_TSTRING) wrong_value(L, index, label(), Message("a string in quotes"));
    std::size_t length = 0;
    const char* text = lua_tolstring(L, index, &length);
    return {text, length};
}

template <class Label>
VectorMap vector_at(lua_State* L, int index, const Label& label) {
    index = lua_absindex(L, index);
    if (lua_type(L, index) == LUA_TTABLE) make_vector_of_table(L, index, label());
    if (lua_type(L, index) == LUA_TNUMBER) {
        push_vector(L, 1).data()[0] = lua_tonumber(L, index);
        lua_replace(L, index);
    }
    if (NumericBlock* block = to_vector(L, index)) return {block->data(), block->rows};
    if (NumericBlock* block = to_matrix(L, index); block != nullptr && block->columns == 1)
        return {block->data(), block->rows};
    wrong_value(L, index, label(), Message("a vector"));
}

auto label_of(int index, ArgumentName what) {
    return [index, what] { return argument_label(index, what); };
}

}  // namespace

Message argument_label(int index, ArgumentName what) {
    return Message("argument {} ({})", index, what.message());
}

Message option_label(const char* name) {
    return Message("option '{}'", name);
}

void refuse_option(const char* name, const Message& requested, const Message& given) {
    throw InvalidArgument("{} must be {}, but {} was given", option_label(name), requested, given);
}

Message given_value(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TNONE:
            return Message("nothing");
        case LUA_TNIL:
            return Message("nil (no value)");
        case LUA_TNUMBER:
            return Message("{}", significant(lua_tonumber(L, index), 10));
        case LUA_TSTRING:
            return Message("the string \"{}\"", lua_tostring(L, index));
        case LUA_TBOOLEAN:
            return Message::verbatim(lua_toboolean(L, index) ? "true" : "false");
        case LUA_TUSERDATA:
            break;
        default:
            return with_article(luaL_typename(L, index));
    }
    if (NumericBlock* v = to_vector(L, index)) return vector_shape(v->rows);
    if (NumericBlock* m = to_matrix(L, index)) return matrix_shape(m->rows, m->columns);
    return with_article(object_name(L, index));
}

void wrong_argument(lua_State* L, int index, ArgumentName what, const Message& requested) {
    if (index > lua_gettop(L))
        throw InvalidArgument("{} is missing; it must be {}", argument_label(index, what), requested);
    wrong_value(L, index, argument_label(index, what), requested);
}

const char* Call::function_name() const {
    return static_cast<const char*>(lua_touserdata(state_, lua_upvalueindex(1)));
}

const FunctionEntry* Call::function_entry() const {
    const char* name = function_name();
    if (name == nullptr) return nullptr;
    const auto& functions = context().functions;
    const auto found = std::ranges::find(functions, std::string_view(name), &FunctionEntry::name);
    return found == functions.end() ? nullptr : *found;
}

void Call::at_most(int arguments) const {
    if (arguments_ <= arguments) return;
    const FunctionEntry* function = function_entry();
    const bool takes_orders =
        function != nullptr &&
        std::ranges::find(function->arguments, ValueKind::kOrders, &ArgumentEntry::kind) != function->arguments.end();
    const bool orders = takes_orders && lua_type(state_, 2) == LUA_TNUMBER && lua_type(state_, 3) == LUA_TNUMBER;
    const Message given = plural(arguments_, "{} was given", "{} were given");
    if (arguments == 0) throw InvalidArgument("accepts no arguments, but {}", given);
    const Message all = plural(arguments, "{} argument", "{} arguments");
    if (orders) {
        std::vector<std::string> numbers;
        for (int i = 2; i <= arguments_ && lua_type(state_, i) == LUA_TNUMBER; ++i)
            numbers.push_back(fmt::format("{:g}", lua_tonumber(state_, i)));
        throw InvalidArgument("accepts at most {}, but {}; write the orders as one table {}", all, given,
                              fmt::format("{{{}}}", fmt::join(numbers, ", ")));
    }
    // An option in the form of MATLAB: a name, after an argument at least, then its value.
    const bool takes_options = function != nullptr && !function->options.empty();
    for (const int name : {arguments, arguments + 1})
        if (takes_options && name > 1 && name < arguments_ && lua_type(state_, name) == LUA_TSTRING)
            throw InvalidArgument("accepts at most {}, but {}; write the options as one table {}", all, given,
                                  fmt::format("{{{} = value}}", lua_tostring(state_, name)));
    throw InvalidArgument("accepts at most {}, but {}", all, given);
}

double Call::number(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a number"));
    return number_at(state_, index, label_of(index, what));
}
double Call::number_or(int index, ArgumentName what, double fallback) const {
    return given(index) ? number(index, what) : fallback;
}
Index Call::integer(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a whole number"));
    return index_of_whole(static_cast<double>(whole_at(state_, index, label_of(index, what))));
}
std::int64_t Call::whole(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a whole number"));
    return whole_at(state_, index, label_of(index, what));
}
Index Call::size(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a whole number"));
    return index_of_whole(static_cast<double>(count_at(state_, index, label_of(index, what))));
}
std::string Call::text(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a string in quotes"));
    return text_at(state_, index, label_of(index, what));
}

VectorMap Call::vector(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a vector"));
    return vector_at(state_, index, label_of(index, what));
}

MatrixMap Call::matrix(int index, ArgumentName what) const {
    if (index > arguments_) wrong_argument(state_, index, what, Message("a matrix"));
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
    print_text(state_, text);
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
int Call::give_integer(std::int64_t value) const {
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

Options::Options(const Call& call, int index, OptionTables known)
    : call_(call), index_(lua_absindex(call.state(), index)), known_(known) {
    if (lua_isnoneornil(call.state(), index_)) {
        index_ = 0;
        return;
    }
    check_names(option_names(known));
    for (const OptionTable& table : known)
        for (const OptionEntry& option : table) check_bounds(option);
}

void Options::check_names(const std::vector<std::string>& known) const {
    lua_State* L = call_.state();
    if (lua_type(L, index_) != LUA_TTABLE) {
        if (known.empty())
            throw InvalidArgument("options must be a table {name = value}, but {} was given", given_value(L, index_));
        throw InvalidArgument("options must be a table {name = value}, but {} was given; the names are {}",
                              given_value(L, index_), listed(known));
    }
    lua_pushnil(L);
    while (lua_next(L, index_)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING) {
            if (known.empty())
                throw InvalidArgument("options must be {name = value}; the entry [{}] has no name", given_value(L, -1));
            throw InvalidArgument("options must be {name = value}; the entry [{}] has no name; the names are {}",
                                  given_value(L, -1), listed(known));
        }
        const std::string name = lua_tostring(L, -1);
        const auto is_known = [&](const std::string& word) { return std::ranges::find(known, word) != known.end(); };
        if (is_known(name)) continue;
        if (const std::string other = other_spelling(name); is_known(other)) {
            if (lua_getfield(L, index_, other.c_str()) != LUA_TNIL)
                throw InvalidArgument("options '{}' and '{}' are equivalent: specify only one", name, other);
            lua_pop(L, 1);
            continue;
        }
        throw InvalidArgument(unknown_option(name, known));
    }
}

void Options::check_bounds(const OptionEntry& option) const {
    const double minimum = option.facts.minimum, maximum = option.facts.maximum;
    if ((std::isinf(minimum) && std::isinf(maximum)) || !has(option.name)) return;
    const double value = number(option.name, 0);
    if (value >= minimum && value <= maximum) return;
    const Message label = option_label(option.name);
    const Number given = significant(value, 10), lowest = significant(minimum, 10), highest = significant(maximum, 10);
    if (std::isinf(maximum)) throw InvalidArgument("{} must be at least {}, but {} was given", label, lowest, given);
    if (std::isinf(minimum)) throw InvalidArgument("{} must be at most {}, but {} was given", label, highest, given);
    throw InvalidArgument("{} must be between {} and {}, but {} was given", label, lowest, highest, given);
}

void Options::read_members(const void* tag, void* into) const {
    for (const OptionTable& table : known_)
        for (const OptionEntry& option : table)
            if (option.tag == tag && has(option.name)) option.read(*this, option, into);
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
            lua_pushstring(L, other_spelling(name).c_str());
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
    const double value = number_at(call_.state(), push(name), label_of(name));
    lua_pop(call_.state(), 1);
    return value;
}

double Options::number(const char* name, double fallback) const {
    return optional_number(name).value_or(fallback);
}

Index Options::size(const char* name, Index fallback) const {
    return has(name) ? index_of_whole(static_cast<double>(whole(name, 0))) : fallback;
}

std::int64_t Options::whole(const char* name, std::int64_t fallback) const {
    if (!has(name)) return fallback;
    const std::int64_t value = count_at(call_.state(), push(name), label_of(name));
    lua_pop(call_.state(), 1);
    return value;
}

bool Options::flag(const char* name, bool fallback) const {
    if (!has(name)) return fallback;
    const int index = push(name);
    if (!lua_isboolean(call_.state(), index))
        wrong_value(call_.state(), index, option_label(name), Message("true or false"));
    const bool value = lua_toboolean(call_.state(), index) != 0;
    lua_pop(call_.state(), 1);
    return value;
}

std::string Options::text(const char* name, const std::string& fallback) const {
    if (!has(name)) return fallback;
    std::string value = text_at(call_.state(), push(name), label_of(name));
    lua_pop(call_.state(), 1);
    return value;
}

std::vector<std::string> Options::texts(const char* name) const {
    lua_State* L = call_.state();
    const int index = push(name);
    std::vector<std::string> values;
    if (lua_type(L, index) == LUA_TTABLE) {
        for (lua_Integer i = 1; lua_rawgeti(L, index, i) != LUA_TNIL; lua_pop(L, 1), ++i)
            values.push_back(text_at(L, -1, label_of(name)));
    } else if (!lua_isnil(L, index)) {
        values.push_back(text_at(L, index, label_of(name)));
    }
    lua_settop(L, index - 1);
    return values;
}

VectorMap Options::vector(const char* name) const {
    return vector_at(call_.state(), push(name), label_of(name));
}

std::map<std::string, double> Options::numbers_by_name(const char* name) const {
    lua_State* L = call_.state();
    const int index = push(name);
    std::map<std::string, double> values;
    if (!lua_isnil(L, index)) {
        if (lua_type(L, index) != LUA_TTABLE)
            wrong_value(L, index, option_label(name), Message("a table such as {a1 = 2}"));
        for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -2) != LUA_TSTRING)
                throw InvalidArgument("{} must contain named values, such as {a1 = 2}", option_label(name));
            const std::string key = lua_tostring(L, -2);
            values[key] = number_at(L, -1, [&] { return Message("{} in {}", key, option_label(name)); });
        }
    }
    lua_settop(L, index - 1);
    return values;
}

std::optional<std::pair<double, double>> Options::range(const char* name) const {
    if (!has(name)) return std::nullopt;
    const VectorMap bounds = vector(name);
    if (bounds.size() != 2)
        throw InvalidArgument("{} must be {low, high}, but it has {}", option_label(name),
                              plural(bounds.size(), "{} value", "{} values"));
    return std::pair(bounds[0], bounds[1]);
}

std::size_t Options::choice(const char* name, std::initializer_list<const char*> choices, std::size_t fallback) const {
    if (!has(name)) return fallback;
    const std::string given = text(name, "");
    const auto found = std::ranges::find(choices, given);
    if (found == choices.end())
        throw InvalidArgument("{} must be one of {}, but \"{}\" was given", option_label(name),
                              listed_in_quotes({choices.begin(), choices.end()}), given);
    return static_cast<std::size_t>(found - choices.begin());
}

std::size_t Options::choice(const OptionEntry& option) const {
    const std::string given = text(option.name, "");
    const auto& choices = option.facts.choices;
    if (given == option.facts.former) return 0;
    const auto found = std::ranges::find(choices, given);
    if (found == choices.end())
        throw InvalidArgument("{} must be one of {}, but \"{}\" was given", option_label(option.name),
                              listed_in_quotes({choices.begin(), choices.end()}), given);
    return static_cast<std::size_t>(found - choices.begin());
}

}  // namespace dynlab::inline scripting
