#include "scripting/objects/frequency_object.h"

namespace dynlab::inline scripting {

std::size_t Userdata<FrequencyData>::outside_bytes(const FrequencyData& data) {
    const Index levels = data.excited.w.size() + data.odd.w.size() + data.even.w.size();
    return sizeof(double) * static_cast<std::size_t>(8 * data.w.size() + 2 * data.realized.size() + 4 * levels);
}

}  // namespace dynlab::inline scripting
