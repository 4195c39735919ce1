#pragma once
#include "numerics/signals/iddata.h"
#include "scripting/objects/boxed.h"

namespace dynlab::inline scripting {

template <>
struct Boxed<IdData> {
    static const ObjectType type;
    static std::size_t outside_bytes(const IdData& data);
    static Digest digest(const IdData& data);
};

int give_data(const Call& call, IdData data);

}  // namespace dynlab::inline scripting
