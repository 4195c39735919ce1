#include "numerics/rigs/rig_record.h"

#include <cmath>
#include <sstream>

#include "numerics/error.h"

namespace dynlab::inline numerics {
namespace {

[[noreturn]] void refuse(const char* rig, const char* name, const char* wanted, double value) {
    std::ostringstream text;
    text << "The " << rig << "'s " << name << " must " << wanted << ", and is " << value;
    throw InvalidArgument(text.str());
}

}  // namespace

Vector sampling_instants(double duration, double Ts) {
    // The small surplus keeps the last sample when duration/Ts rounds to just below a whole number.
    const Index steps = static_cast<Index>(std::floor(duration / Ts + 1e-9));
    return Vector::LinSpaced(steps + 1, 0, static_cast<double>(steps)) * Ts;
}

void require_positive(const char* rig, const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value)) refuse(rig, name, "be positive", value);
}

void require_not_negative(const char* rig, const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value)) refuse(rig, name, "not be negative", value);
}

}  // namespace dynlab::inline numerics
