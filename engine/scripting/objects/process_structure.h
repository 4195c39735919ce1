#pragma once
#include "numerics/models/process_model.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// A process model before it has values.
template <>
struct Userdata<ProcessStructure> {
    static constexpr ObjectType type{"process structure"};
    static std::size_t outside_bytes(const ProcessStructure&) { return 0; }
};

/// A text such as "P1D", or what idproc("P1D") gives.
inline ProcessStructure process_structure_argument(const Call& call, int index) {
    if (const ProcessStructure* structure = to_object<ProcessStructure>(call.state(), index)) return *structure;
    return ProcessStructure::parse(call.text(index, "structure"));
}

}  // namespace dynlab::inline scripting
