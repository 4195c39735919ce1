#include "scripting/bind/grey_box/script_equations.h"

#include <re2/re2.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/reader.h"
#include "scripting/bind/grey_box/script_values.h"
#include "scripting/objects/traced_value.h"
#include "scripting/runtime/errors.h"

namespace dynlab::inline scripting {
namespace {

using Node = ExpressionTape::Node;

Message rates_wanted(const ScriptEquations& equations) {
    return Message("one derivative per state ({}: {})", plural(equations.states.size(), "{} state", "{} states"),
                   listed(equations.states));
}
Message start_wanted(const ScriptEquations& equations) {
    return Message("one value per state ({}: {})", plural(equations.states.size(), "{} state", "{} states"),
                   listed(equations.states));
}

template <class Value>
struct Matrices {
    Entries<Value> A, B, C, D;
};

/// A, B, C, D on top of the stack, D or nothing; pops them.
template <class Value, class Read>
Matrices<Value> read_matrices(lua_State* L, Index n, const Read& read) {
    const int first = lua_gettop(L) - 3;
    Matrices<Value> all{read_matrix<Value>(L, first, "A", read),
                        read_matrix<Value>(L, first + 1, "B", read),
                        read_matrix<Value>(L, first + 2, "C", read),
                        {}};
    if (!lua_isnil(L, first + 3)) all.D = read_matrix<Value>(L, first + 3, "D", read);
    lua_settop(L, first - 1);
    const auto check = [](const char* name, const Entries<Value>& entries, Index rows, Index columns) {
        if (entries.rows != rows || entries.columns != columns)
            throw InvalidArgument("the matrix {} must be {} x {}, but it is {} x {}", name, rows, columns, entries.rows,
                                  entries.columns);
    };
    check("A", all.A, n, n);
    check("B", all.B, n, all.B.columns);
    check("C", all.C, all.C.rows, n);
    if (all.D.rows > 0) check("D", all.D, all.C.rows, all.B.columns);
    return all;
}

// ---- tracing

/// Lua's own mathematics takes numbers alone: the message says what to write in its place.
Message with_remedy(const Message& message) {
    static const RE2 kOfMath(R"(^(.*?)bad argument #\d+ to '(\w+)' \(number expected, got)", RE2::Latin1);
    static const std::set<std::string> kFollowed = {"sin", "cos",  "tan", "atan", "exp",
                                                    "log", "sqrt", "abs", "max",  "min"};
    std::string place, name;
    if (!RE2::PartialMatch(message_text(message), kOfMath, &place, &name)) return message;
    if (kFollowed.contains(name))
        return Message("{}math.{} accepts only numbers, so write {}(...), which also supports symbolic values", place,
                       name, name);
    return Message("{}{} accepts only numbers and does not support symbolic values", place, name);
}

class Tracer {
  public:
    explicit Tracer(ScriptEquations& equations)
        : equations_(equations), L_(equations.rates->state()), trace_(std::make_shared<Trace>()) {}

    std::optional<TracedFunctions> run(Message& reason) {
        const int top = lua_gettop(L_);
        TracedFunctions functions;
        try {
            const bool followed = equations_.of_matrices ? follow_matrices(functions) : follow(functions);
            lua_settop(L_, top);
            if (!followed) {
                reason = std::move(reason_);
                return std::nullopt;
            }
        } catch (const InvalidArgument& error) {
            lua_settop(L_, top);
            reason = error.message();
            return std::nullopt;
        }
        functions.inputs = equations_.inputs < 0 ? trace_->inputs : equations_.inputs;
        functions.tape = trace_->tape;
        return functions;
    }

    bool inputs_indexed() const { return trace_->inputs_indexed; }

  private:
    void push_traced(Operation kind, Index i = 0, bool inputs = false) {
        push_object(L_, TracedValue{trace_, trace_->tape.variable(kind, i), inputs});
    }
    void push_parameters() {
        push_by_name(L_, "parameter", "p", equations_.parameters,
                     [&](Index i) { push_traced(Operation::kParameter, i); });
    }
    void push_signals() {
        push_traced(Operation::kTime);
        push_by_name(L_, "state", "x", equations_.states, [&](Index i) { push_traced(Operation::kState, i); });
        push_traced(Operation::kInput, 0, true);
    }

    /// Calls the function below its arguments on the stack; false, with the reason, if it fails.
    bool called(int arguments, int results) {
        if (lua_pcall(L_, arguments, results, 0) == LUA_OK) return true;
        pass_stop_on(L_);
        reason_ = with_remedy(error_at(L_, -1).with_place());
        return false;
    }
    std::optional<Node> node_on_top() const { return traced_node(L_, -1, trace_); }
    std::vector<Node> nodes_on_top(const RequestedValues& requested) {
        return read_list<Node>(L_, requested, [this] { return node_on_top(); });
    }

    bool follow(TracedFunctions& functions) {
        equations_.rates->push();
        push_signals();
        push_parameters();
        if (!called(4, 1)) return false;
        const Message what = rates_wanted(equations_);
        functions.rates = nodes_on_top({"f", &what, static_cast<Index>(equations_.states.size())});
        return follow_outputs(functions) && follow_initial(functions);
    }

    bool follow_outputs(TracedFunctions& functions) {
        if (!equations_.outputs) {
            for (std::size_t i = 0; i < equations_.states.size(); ++i)
                functions.outputs.push_back(trace_->tape.variable(Operation::kState, static_cast<Index>(i)));
            return true;
        }
        equations_.outputs->push();
        push_signals();
        push_parameters();
        if (!called(4, 1)) return false;
        functions.outputs = nodes_on_top({"h", nullptr, -1});
        return true;
    }

    bool follow_initial(TracedFunctions& functions) {
        if (!equations_.initial) {
            for (const InitialEntry& entry : equations_.initial_entries)
                functions.initial.push_back(entry.parameter < 0
                                                ? trace_->tape.constant(entry.value)
                                                : trace_->tape.variable(Operation::kParameter, entry.parameter));
            return true;
        }
        equations_.initial->push();
        push_parameters();
        if (!called(1, 1)) return false;
        const Message what = start_wanted(equations_);
        functions.initial = nodes_on_top({"x0", &what, static_cast<Index>(equations_.states.size())});
        return true;
    }

    /// sum_j row_j x_j
    Node combination(const Entries<Node>& entries, Index row, Operation kind, Node sum) {
        ExpressionTape& tape = trace_->tape;
        for (Index j = 0; j < entries.columns; ++j) {
            const Node entry = entries.values[static_cast<std::size_t>(row * entries.columns + j)];
            sum = tape.apply(Operation::kAdd, sum, tape.apply(Operation::kMultiply, entry, tape.variable(kind, j)));
        }
        return sum;
    }

    bool follow_matrices(TracedFunctions& functions) {
        equations_.rates->push();
        push_parameters();
        if (!called(1, 4)) return false;
        const auto n = static_cast<Index>(equations_.states.size());
        const auto all = read_matrices<Node>(L_, n, [this] { return node_on_top(); });
        trace_->inputs = all.B.columns;
        const Node zero = trace_->tape.constant(0);
        for (Index i = 0; i < n; ++i)
            functions.rates.push_back(
                combination(all.B, i, Operation::kInput, combination(all.A, i, Operation::kState, zero)));
        for (Index i = 0; i < all.C.rows; ++i) {
            const Node of_states = combination(all.C, i, Operation::kState, zero);
            functions.outputs.push_back(all.D.rows > 0 ? combination(all.D, i, Operation::kInput, of_states)
                                                       : of_states);
        }
        return follow_initial(functions);
    }

    ScriptEquations& equations_;
    lua_State* L_;
    std::shared_ptr<Trace> trace_;
    Message reason_;
};

// ---- calling

Message more_than_rates() {
    return Message(
        "f must return only the derivatives, in one table, as in return {dx1, dx2}, but it returned several values. "
        "Specify the outputs with the option outputs = function(t, x, u, p) return {y1} end");
}
Message more_than_outputs() {
    return Message("h must return the outputs in one table, as in return {y1, y2}, but it returned several values");
}
Message more_than_start() {
    return Message(
        "x0 must return the initial states in one table, as in return {x1, x2}, but it returned several values");
}
Message more_than_matrices() {
    return Message("f must return only the matrices A, B, C, D, but it returned more than four values");
}

/// A function of (t, x, u, p), called with numbers.
Vector called_with(const ScriptEquations& equations, const ScriptFunction& function, const RequestedValues& requested,
                   double t, const Vector& x, const Vector& u, const Vector& p) {
    lua_State* L = function.state();
    luaL_checkstack(L, 16, "grey-box model");
    function.push();
    lua_pushnumber(L, t);
    push_numbers(L, "state", "x", equations.states, x);
    push_inputs(L, u, equations.inputs_indexed);
    push_numbers(L, "parameter", "p", equations.parameters, p);
    call_or_throw(L, 4, 1, &function == equations.rates.get() ? more_than_rates : more_than_outputs);
    return numbers_on_top(L, requested);
}

Vector initial_values(const ScriptEquations& equations, const Vector& p) {
    if (equations.initial) {
        lua_State* L = equations.initial->state();
        equations.initial->push();
        push_numbers(L, "parameter", "p", equations.parameters, p);
        call_or_throw(L, 1, 1, more_than_start);
        const Message what = start_wanted(equations);
        return numbers_on_top(L, {"x0", &what, static_cast<Index>(equations.states.size())});
    }
    Vector values(static_cast<Index>(equations.initial_entries.size()));
    for (Index i = 0; i < values.size(); ++i) {
        const InitialEntry& entry = equations.initial_entries[static_cast<std::size_t>(i)];
        values[i] = entry.parameter < 0 ? entry.value : p[entry.parameter];
    }
    return values;
}

Matrix matrix_of(const Entries<double>& entries) {
    return Eigen::Map<const RowMatrix>(entries.values.data(), entries.rows, entries.columns);
}

/// The matrices that a function of p gives, at the last p.
class CalledMatrices {
  public:
    explicit CalledMatrices(const ScriptEquations& equations) : equations_(equations) {}

    const std::array<Matrix, 4>& at(const Vector& p) {
        if (last_.size() == p.size() && last_ == p) return matrices_;
        lua_State* L = equations_.rates->state();
        luaL_checkstack(L, 16, "grey-box model");
        equations_.rates->push();
        push_numbers(L, "parameter", "p", equations_.parameters, p);
        call_or_throw(L, 1, 4, more_than_matrices);
        const auto all =
            read_matrices<double>(L, static_cast<Index>(equations_.states.size()), [L] { return number_at_top(L); });
        matrices_ = {matrix_of(all.A), matrix_of(all.B), matrix_of(all.C),
                     all.D.rows > 0 ? matrix_of(all.D) : Matrix::Zero(all.C.rows, all.B.columns)};
        last_ = p;
        return matrices_;
    }

  private:
    const ScriptEquations& equations_;
    Vector last_;
    std::array<Matrix, 4> matrices_;
};

CalledFunctions call_matrices(const std::shared_ptr<ScriptEquations>& own, const Vector& p) {
    const auto matrices = std::make_shared<CalledMatrices>(*own);
    CalledFunctions functions;
    functions.inputs = matrices->at(p)[1].cols();
    functions.outputs_count = matrices->at(p)[2].rows();
    functions.rates = [own, matrices](double, const Vector& x, const Vector& u, const Vector& at) -> Vector {
        const auto& [A, B, C, D] = matrices->at(at);
        return A * x + B * u;
    };
    functions.outputs = [own, matrices](double, const Vector& x, const Vector& u, const Vector& at) -> Vector {
        const auto& [A, B, C, D] = matrices->at(at);
        return C * x + D * u;
    };
    return functions;
}

CalledFunctions call_signals(const std::shared_ptr<ScriptEquations>& own, const Vector& p) {
    CalledFunctions functions;
    const auto n = static_cast<Index>(own->states.size());
    functions.inputs = own->inputs < 0 ? 1 : own->inputs;
    functions.rates = [own, n, what = rates_wanted(*own)](double t, const Vector& x, const Vector& u,
                                                          const Vector& at) {
        return called_with(*own, *own->rates, {"f", &what, n}, t, x, u, at);
    };
    if (!own->outputs) {
        functions.outputs_count = n;
        functions.outputs = [](double, const Vector& x, const Vector&, const Vector&) { return x; };
        return functions;
    }
    const Vector x = initial_values(*own, p), u = Vector::Zero(functions.inputs);
    functions.outputs_count = called_with(*own, *own->outputs, {"h", nullptr, -1}, 0, x, u, p).size();
    const Message as_at_first =
        Message("{}, as in the first call", plural(functions.outputs_count, "{} output", "{} outputs"));
    functions.outputs = [own, what = as_at_first, count = functions.outputs_count](
                            double t, const Vector& at_x, const Vector& at_u, const Vector& at_p) {
        return called_with(*own, *own->outputs, {"h", &what, count}, t, at_x, at_u, at_p);
    };
    return functions;
}

}  // namespace

std::optional<TracedFunctions> trace_functions(ScriptEquations& equations, Message& reason) {
    Tracer tracer(equations);
    auto functions = tracer.run(reason);
    equations.inputs_indexed = tracer.inputs_indexed();
    return functions;
}

CalledFunctions call_functions(ScriptEquations& equations, const Vector& p) {
    const auto own = std::make_shared<ScriptEquations>(equations);
    CalledFunctions functions = own->of_matrices ? call_matrices(own, p) : call_signals(own, p);
    functions.states = static_cast<Index>(own->states.size());
    functions.initial_state = [own](const Vector& at) { return initial_values(*own, at); };
    const Vector x = functions.initial_state(p), u = Vector::Zero(functions.inputs);
    functions.rates(0, x, u, p);
    functions.outputs(0, x, u, p);
    return functions;
}

bool agree(const TracedFunctions& traced, const CalledFunctions& called, const Vector& p) {
    const auto same = [](const Vector& a, const Vector& b) {
        if (a.size() != b.size()) return false;
        for (Index i = 0; i < a.size(); ++i) {
            const bool both_nan = std::isnan(a[i]) && std::isnan(b[i]);
            if (!both_nan && a[i] != b[i] && !(std::abs(a[i] - b[i]) <= 1e-9 * (std::abs(a[i]) + std::abs(b[i]))))
                return false;
        }
        return true;
    };
    const auto equations = traced_equations(traced);
    const auto evaluation = equations->evaluation({});
    evaluation->set_parameters(p);
    GreyValues at;
    const Vector start = called.initial_state(p);
    evaluation->initial_state(Derivatives::kNone, at);
    if (!same(at.values, start)) return false;
    const std::array<std::array<double, 2>, 6> places = {
        {{0, 0}, {0.37, 0.37}, {-0.61, -0.61}, {1.83, 0}, {0, 1.83}, {-0.29, 0}}};
    for (const auto& [shift, input] : places) {
        const Vector x = start.array() + shift, u = Vector::Constant(std::max(traced.inputs, called.inputs), input);
        const Vector own_u = u.head(called.inputs);
        try {
            evaluation->rates(shift, x.data(), u.data(), Derivatives::kNone, at);
            if (!same(at.values, called.rates(shift, x, own_u, p))) return false;
            evaluation->outputs(shift, x.data(), u.data(), Derivatives::kNone, at);
            if (!same(at.values, called.outputs(shift, x, own_u, p))) return false;
        } catch (const InvalidArgument&) {
            continue;  // outside what the functions are for
        }
    }
    return true;
}

}  // namespace dynlab::inline scripting
