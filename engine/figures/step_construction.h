#pragma once
#include <string>
#include <vector>

#include "figures/figure.h"

namespace dynlab::inline figures {

/// A step response with the values that were read from it with a ruler. Times are in seconds on the data's time axis.
struct StepConstruction {
    struct Reading {
        std::string name;  ///< "settling", "overshoot", or the part of the change as written ("28.3 %")
        double time, value;
    };
    Vector t, y;      ///< the data
    Vector smoothed;  ///< the curve the readings come from; none when empty
    double step_time = 0;
    double initial = 0, final = 0;  ///< output levels
    std::vector<Reading> readings;
    Message x_label = axis_label(Message("time"), "s"), y_label;
};

/// Levels, and for each reading its construction: the 5 % band with the response time T_r, the first overshoot D_1 with
/// its time T_1, and points at a part of the change with their lines to both axes.
Figure step_construction(const StepConstruction& construction);

}  // namespace dynlab::inline figures
