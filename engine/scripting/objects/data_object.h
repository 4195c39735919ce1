#pragma once
#include "data_io/variable.h"
#include "numerics/signals/iddata.h"
#include "scripting/objects/boxed.h"

namespace dynlab {

template <>
struct Boxed<IdData> {
    static const ObjectType type;
    static std::size_t outside_bytes(const IdData& data);
};

int give_data(const Call& call, IdData data);
/// Pushes a variable of a data file; structs and cell arrays become tables.
void push_variable(const Call& call, const Variable& variable);

}  // namespace dynlab
