#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// Impulse response g_0 .. g_n of y(k) = sum_i g_i u(k - i) + noise; its sum is the static gain (once it has died out),
/// g_i/Ts approximates the continuous impulse response.
struct ImpulseEstimate {
    Vector t;         ///< lags i Ts
    Vector response;  ///< g_i
    Vector std;       ///< standard errors
    Vector null_std;  ///< what they would be if g were zero: a band around zero that only a real response leaves
    double noise_variance = 0;
    Matrix covariance;                ///< of g; empty if the method does not provide it
    std::optional<Index> first;       ///< lag of the first significant response
    std::optional<double> dead_time;  ///< in the unit of t; empty if no response exceeds the noise
    Message message;
    std::vector<Message> warnings;
};

/// Finds the first lag that together with the next lies beyond `half_width` of its null_std on the same side, and adds
/// the resulting dead time to the message. A held input needs one lag to act, so the dead time is about first - 1
/// samples. The response to a linearly interpolated input begins one lag earlier, so the dead time is about first
/// samples. `unit` is the time unit of Ts.
void read_dead_time(ImpulseEstimate& estimate, double Ts, const std::string& unit, Hold hold, double half_width);

/// Returns `lags` if positive, otherwise the smaller of 70 and a fifth of the shortest experiment. Throws
/// InvalidArgument, with a message that begins with `caller`, for fewer than three samples per lag.
Index lags_or_default(const std::string& caller, Index lags, Index shortest);

}  // namespace dynlab::inline numerics
