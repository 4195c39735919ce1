#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/step_data.h"

namespace dynlab::inline numerics {

/// One point of the graphical construction: where the response was read.
struct ReadingPoint {
    std::string name;  ///< "settling", "overshoot", "28.3 %", "63.2 %"
    double time;       ///< instant on the time axis of the data, s
    double value;      ///< output there
};

struct StepTestResult {
    TransferFunction model;
    std::vector<std::string> names;    ///< of the parameters
    Vector parameters;                 ///< one for each name
    StepData step_data;                ///< levels with their intervals, step, noise, smoothed response
    std::vector<ReadingPoint> points;  ///< in the order of time
    Message message;                   ///< one sentence or two
};

/// Parameters of a transfer function read off a step response as one does with a ruler: K = output change over
/// input change from the two plateaus, the times from the smoothed response, which makes the readings insensitive to
/// noise (see read_step_data, also for what throws). They are starting points, not optimal estimates; no
/// standard errors come with them.

/// K/(1 + T s), names {"K", "T"}: T = Tr5/3, Tr5 the time after the step from which the smoothed response stays within
/// 5 % of its final value (the response of a first-order system is then at 1 - exp(-3)). Throws InvalidArgument
/// when the response settles within two samples.
StepTestResult step_first_order(const IdData& data);

/// K w0^2/(s^2 + 2 z w0 s + w0^2), names {"K", "z", "w0"}: from the first overshoot D1 (part of the change) and its
/// time T1 after the step (where the cubic through the upper quarter of the overshoot is highest), z =
/// sqrt(ln(D1)^2/(ln(D1)^2 + pi^2)) and w0 = pi/(T1 sqrt(1 - z^2)). Throws InvalidArgument if no overshoot exceeds the
/// noise.
StepTestResult step_second_order(const IdData& data);

/// K exp(-D s)/(1 + T s), names {"K", "T", "D"}: two points (Broida). At t1 the response has risen to
/// 28.3 % = 1 - exp(-1/3), at t2 to 63.2 % = 1 - exp(-1), both counted from the step: T = 1.5 (t2 - t1),
/// D = t2 - T = (3 t1 - t2)/2, and D = 0 when noise makes it negative.
StepTestResult step_delayed(const IdData& data);

}  // namespace dynlab::inline numerics
