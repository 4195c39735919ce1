#include "scripting/objects/traced_value.h"

#include <array>

namespace dynlab::inline scripting {
namespace {

using Node = ExpressionTape::Node;

Node operand_of(const Call& call, int index, const std::shared_ptr<Trace>& trace) {
    if (const auto node = traced_node(call.state(), index, trace)) return *node;
    throw InvalidArgument("a symbolic value can be combined only with numbers, but {} was given",
                          given_value(call.state(), index));
}

template <Operation kOperation, int kOperands>
int operate(Call& call) {
    return give_traced_operation(call, trace_among(call), kOperation, kOperands);
}

int refuse_order(Call&) {
    throw InvalidArgument(
        "symbolic values cannot be compared. Use where(c, a, b), which returns a if c > 0 and b otherwise; sign, max, "
        "min and abs also support symbolic values");
}

int input_of(Call& call) {
    const TracedValue& value = object_argument<TracedValue>(call, 1, "u");
    if (!value.inputs)
        throw InvalidArgument(
            "this symbolic value is a scalar, which has no elements; "
            "only the input u has numbered elements, such as u[1]");
    const Index i = call.integer(2, Message("number of the input"));
    if (i < 1 || i > 1000) throw InvalidArgument("u[{}] does not exist: inputs are numbered from 1 to 1000", i);
    value.trace->inputs = std::max(value.trace->inputs, i);
    value.trace->inputs_indexed = true;
    return give_traced(call, value.trace, value.trace->tape.variable(Operation::kInput, i - 1));
}

int text_of(Call& call) {
    return call.give(std::string("a symbolic value"));
}

constexpr std::array kTracedOperators = {Member{"__add", guarded<operate<Operation::kAdd, 2>>},
                                         Member{"__sub", guarded<operate<Operation::kSubtract, 2>>},
                                         Member{"__mul", guarded<operate<Operation::kMultiply, 2>>},
                                         Member{"__div", guarded<operate<Operation::kDivide, 2>>},
                                         Member{"__pow", guarded<operate<Operation::kPower, 2>>},
                                         Member{"__unm", guarded<operate<Operation::kNegate, 1>>},
                                         Member{"__lt", guarded<refuse_order>},
                                         Member{"__le", guarded<refuse_order>},
                                         Member{"__eq", guarded<refuse_order>},
                                         Member{"__tostring", guarded<text_of>}};

constexpr std::array kTracedTypes = {
    TypeEntry{&Userdata<TracedValue>::type, {}, {}, kTracedOperators, guarded<input_of>}};

}  // namespace

TypeEntries traced_types() {
    return kTracedTypes;
}

std::optional<Node> traced_node(lua_State* L, int index, const std::shared_ptr<Trace>& trace) {
    if (lua_type(L, index) == LUA_TNUMBER) return trace->tape.constant(lua_tonumber(L, index));
    const TracedValue* value = to_object<TracedValue>(L, index);
    if (value == nullptr || value->trace != trace) return std::nullopt;
    if (value->inputs) trace->inputs = std::max<Index>(trace->inputs, 1);
    return value->node;
}

int give_traced(const Call& call, const std::shared_ptr<Trace>& trace, Node node) {
    push_object(call.state(), TracedValue{trace, node});
    return 1;
}

std::shared_ptr<Trace> trace_among(const Call& call) {
    for (int i = 1; i <= call.count(); ++i)
        if (const TracedValue* value = to_object<TracedValue>(call.state(), i)) return value->trace;
    return nullptr;
}

int give_traced_operation(const Call& call, const std::shared_ptr<Trace>& trace, Operation operation, int operands) {
    std::array<Node, 3> nodes = {-1, -1, -1};
    for (int i = 0; i < operands; ++i) {
        if (i >= call.count()) throw InvalidArgument("argument {} is missing", i + 1);
        nodes[static_cast<std::size_t>(i)] = operand_of(call, i + 1, trace);
    }
    return give_traced(call, trace, trace->tape.apply(operation, nodes[0], nodes[1], nodes[2]));
}

}  // namespace dynlab::inline scripting
