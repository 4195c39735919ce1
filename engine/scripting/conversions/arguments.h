#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "numerics/error.h"
#include "scripting/conversions/numeric.h"
#include "scripting/runtime/context.h"
#include "scripting/runtime/option_entry.h"

namespace dynlab::inline scripting {

/// The name of an argument in messages: a name of the signature, "data", or a phrase, Message("your prediction").
/// Creating one costs nothing for each argument that is read; both texts must outlive it.
class ArgumentName {
  public:
    ArgumentName(const char* name) : name_(name) {}            // NOLINT: names are arguments' names
    ArgumentName(const Message& phrase) : phrase_(&phrase) {}  // NOLINT
    Message message() const { return phrase_ != nullptr ? *phrase_ : Message::verbatim(name_); }

  private:
    const char* name_ = nullptr;
    const Message* phrase_ = nullptr;
};

/// "argument 2 (orders)", with which messages begin; a method's are counted without the object (run_guarded).
Message argument_label(int index, ArgumentName what);

/// One call from a script: checked reading of its arguments, writing of its results. Reading throws InvalidArgument
/// that names the argument, what was wanted and what was given; `guarded` turns it into a Lua error with file and line.
class Call {
  public:
    explicit Call(lua_State* state) : state_(state), arguments_(lua_gettop(state)) {}

    lua_State* state() const { return state_; }
    RuntimeContext& context() const { return context_of(state_); }
    int count() const { return arguments_; }
    bool given(int index) const { return index <= arguments_ && !lua_isnoneornil(state_, index); }
    const char* function_name() const;  ///< the Lua name of the running function
    /// The object that the running function was added to the runtime with (Runtime::add_functions).
    template <class T>
    T& owner() const {
        return *static_cast<T*>(lua_touserdata(state_, lua_upvalueindex(2)));
    }
    int type(int index) const { return index <= arguments_ ? lua_type(state_, index) : LUA_TNONE; }
    void at_most(int arguments) const;  ///< throws when the script gave more

    double number(int index, ArgumentName what) const;
    double number_or(int index, ArgumentName what, double fallback) const;
    Index integer(int index, ArgumentName what) const;       ///< index_of_whole()
    Index size(int index, ArgumentName what) const;          ///< the same from 0 on
    std::int64_t whole(int index, ArgumentName what) const;  ///< for what counts no elements, such as seeds
    std::string text(int index, ArgumentName what) const;

    /// A vector of the script, or a table of numbers, which is made into one in its place.
    VectorMap vector(int index, ArgumentName what) const;
    /// A matrix, a vector (one column) or a table of tables (rows).
    MatrixMap matrix(int index, ArgumentName what) const;
    bool holds_vector(int index) const;  ///< vector userdata or plain table of numbers

    std::function<bool()> cancel() const;       ///< for long work of the core: true after Ctrl-C or a limit of time
    void print(const std::string& text) const;  ///< adds to the run results and prints at once
    /// Whole lines; between two blocks of several comes an empty one.
    void print_lines(const std::string& text) const;

    int give(double value) const;
    int give_integer(std::int64_t value) const;
    int give(bool value) const;
    int give(const std::string& value) const;
    int give_vector(const VectorView& v) const;
    int give_matrix(const MatrixView& m) const;

  private:
    const FunctionEntry* function_entry() const;  ///< of the running function; nullptr for a method
    lua_State* state_;
    int arguments_;
};

/// `requested`: with its article, "a number".
[[noreturn]] void wrong_argument(lua_State* L, int index, ArgumentName what, const Message& requested);
/// "option 'Ts'"
Message option_label(const char* name);
/// Throws InvalidArgument: what the option must be, and what was given.
[[noreturn]] void refuse_option(const char* name, const Message& requested, const Message& given);
/// The value at a stack index, in words: "the text "zoh"", "nil (no value)", "a vector of 5 values".
Message given_value(lua_State* L, int index);

/// A table {name = value} whose names are all known; an unknown one throws InvalidArgument with the nearest known name.
class Options {
  public:
    /// An absent table means all defaults. `index` may be any stack index. Numbers must be within the bounds that their
    /// entries state.
    Options(const Call& call, int index, OptionTables known);

    /// Sets the members of a struct that have an option which is given (conversions/option_member.h).
    template <class T>
    void read(T& into) const;

    bool has(const char* name) const;
    double number(const char* name, double fallback) const;
    std::optional<double> optional_number(const char* name) const;
    Index size(const char* name, Index fallback) const;
    std::int64_t whole(const char* name, std::int64_t fallback) const;  ///< from 0 on, for what counts no elements
    bool flag(const char* name, bool fallback) const;
    std::string text(const char* name, const std::string& fallback) const;
    std::vector<std::string> texts(const char* name) const;  ///< a text or a list of texts; empty when absent
    VectorMap vector(const char* name) const;                ///< throws when absent
    std::map<std::string, double> numbers_by_name(const char* name) const;   ///< {a1 = 2}; empty when absent
    std::optional<std::pair<double, double>> range(const char* name) const;  ///< {low, high}
    /// Place of the text among `choices`; throws for any other text, naming them.
    std::size_t choice(const char* name, std::initializer_list<const char*> choices, std::size_t fallback) const;
    std::size_t choice(const OptionEntry& option) const;  ///< of one that is given
    const Call& call() const { return call_; }
    /// Pushes the option's value (nil when absent) and returns its stack index.
    int push(const char* name) const;

  private:
    void check_names(const std::vector<std::string>& known) const;
    void check_bounds(const OptionEntry& option) const;
    void read_members(const void* tag, void* into) const;
    Call call_;
    int index_;
    OptionTables known_;
};

template <class T>
inline constexpr char options_tag = 0;  ///< its address distinguishes structs of options

template <class T>
void Options::read(T& into) const {
    read_members(&options_tag<T>, &into);
}

using Binding = int (*)(Call&);
int run_guarded(lua_State* L, Binding body);

/// The only way a binding is called: C++ exceptions of the core become Lua errors "file:line: function: sentence", of
/// which the context knows the message (RuntimeContext::raised).
/// Lua's own exceptions pass through untouched, so that destructors run.
template <Binding kBody>
int guarded(lua_State* L) {
    return run_guarded(L, kBody);
}

}  // namespace dynlab::inline scripting
