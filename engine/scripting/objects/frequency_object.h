#pragma once
#include "numerics/models/frequency_data.h"
#include "scripting/conversions/userdata.h"

namespace dynlab::inline scripting {

/// A measured frequency response: what idfrd, bla, spa and etfe give.
template <>
struct Userdata<FrequencyData> {
    static constexpr ObjectType type{"idfrd"};
    static std::size_t outside_bytes(const FrequencyData& data);
};

/// Whether there is a frequency response at a stack index.
inline bool holds_response(const Call& call, int index) {
    return index <= call.count() && to_object<FrequencyData>(call.state(), index) != nullptr;
}

}  // namespace dynlab::inline scripting
