#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Seconds in a unit of time (s, ms, µs, min, h, days, with English, French and German names); nothing for any other
/// text. In `any_case`, and without a point at the end, as in headers of time columns: MS, Sec., Minuten; also a number
/// of units, as in "10 ms", "x 10 ms" and "1/100 s".
std::optional<double> seconds_of(std::string_view unit, bool any_case = false);

/// What the name of a column or variable says about time.
struct TimeName {
    bool is_time = false;                  ///< it consists of words for a time: t, time, Zeit, elapsed_time_ms, TimeUS
    std::optional<std::string> unit = {};  ///< the unit in it, as it is written there
};
TimeName time_name_of(std::string_view name);

}  // namespace dynlab::inline data_io
