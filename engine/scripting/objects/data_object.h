#pragma once
#include "numerics/signals/iddata.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

template <>
struct Userdata<IdData> {
    static constexpr ObjectType type{"iddata"};
    static std::size_t outside_bytes(const IdData& data);
    static Digest digest(const IdData& data);
};

/// The data of argument `index`, which must have an output: all functions but simulations and pictures need one.
template <>
Access<IdData>& object_argument<IdData>(const Call& call, int index, ArgumentName what);
/// The same, or inputs alone as iddata(nil, u, Ts) gives them.
const IdData& signals_of_argument(const Call& call, int index, ArgumentName what);

int give_data(const Call& call, IdData data);

}  // namespace dynlab::inline scripting
