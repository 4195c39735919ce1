#pragma once
#include <memory>
#include <optional>

#include "numerics/models/expression.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// What a script's function did with values that it was called with once: the expressions of its results.
struct Trace {
    ExpressionTape tape;
    Index inputs = 0;             ///< as many as were looked at
    bool inputs_indexed = false;  ///< u[1] was written
};

/// A value that is not known yet. `inputs`: the value represents all inputs; used without an index, it is the first
/// input.
struct TracedValue {
    std::shared_ptr<Trace> trace;
    ExpressionTape::Node node = 0;
    bool inputs = false;
};

template <>
struct Userdata<TracedValue> {
    static constexpr ObjectType type{"traced value"};
    static std::size_t outside_bytes(const TracedValue&) { return 0; }
};

TypeEntries traced_types();

/// The expression of the value at a stack index, a traced value of `trace` or a number; nothing for anything else, or
/// for a value of another trace.
std::optional<ExpressionTape::Node> traced_node(lua_State* L, int index, const std::shared_ptr<Trace>& trace);
int give_traced(const Call& call, const std::shared_ptr<Trace>& trace, ExpressionTape::Node node);

/// The trace that one of the arguments belongs to; nullptr when all are known.
std::shared_ptr<Trace> trace_among(const Call& call);
/// The result of an operation on the arguments, of which at least one is traced. Throws InvalidArgument for arguments
/// that are neither traced nor numbers.
int give_traced_operation(const Call& call, const std::shared_ptr<Trace>& trace, Operation operation, int operands);

}  // namespace dynlab::inline scripting
