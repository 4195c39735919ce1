#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

/// How the day, the month and the clock are written in cells.
enum class ClockForm {
    kTime,         ///< 14:02:33.118, 2:02:33 PM, 25:10:00
    kTwoFields,    ///< 14:02, of hours and minutes or of minutes and seconds
    kDate,         ///< a day with or without time: ISO 8601, 11.3.2025, 11-Mar-2025, 20250311T140233Z
    kDayFirst,     ///< a day such as 13/3/2025
    kMonthFirst,   ///< a day such as 3/13/2025
    kEitherFirst,  ///< a day such as 3/4/2025, read with the day first
};
struct ClockCell {
    ClockForm form;
    double seconds;     ///< since midnight, or since 1970 (UTC where the cell names its zone)
    bool date = false;  ///< a day without time
};
/// Reads a whole cell as a time of day or a day; nothing for any other text.
std::optional<ClockCell> clock_cell(std::string_view cell);

/// The seconds of days whose number is at most 12, with the number of the month instead.
double with_day_as_month(double seconds);

/// Seconds since 1970 as 2025-03-11 14:02:33.
std::string date_text(double seconds);

}  // namespace dynlab::inline data_io
