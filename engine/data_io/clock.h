#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/tables/column_format.h"
#include "data_io/tables/import_options.h"
#include "data_io/variable.h"

namespace dynlab::inline data_io {

struct LoadedData;

/// How instants follow each other.
struct InstantSpacing {
    double step = 0;               ///< mean distance where it is even, else the median; in the unit of the instants
    bool even = false;             ///< no distance differs from the mean by more than 0.1 %
    std::vector<Index> gaps = {};  ///< i: from instant i to the next it is more than 1.5 times the step
    std::optional<Index> disorder = {};  ///< first i whose next instant is not later; then the other fields are empty
};
/// Of at least two instants.
InstantSpacing spacing_of(const Vector& instants);

/// The step of `count` even instants as one writes it, where that leads no sample astray by a hundredth of a step.
double written_step(double step, Index count);

/// The instants of a file's samples.
struct Clock {
    std::string name;                 ///< of the column that holds them
    Vector t;                         ///< s, increasing; from 0 where the column holds days or times of day
    InstantSpacing spacing;           ///< s; the step of even instants as one would write it
    std::vector<Message> notes = {};  ///< what was assumed, and how it is changed
};

struct ClockSearch {
    std::string name = {};  ///< of the column that was looked at; empty where there is none
    std::optional<Clock> clock = {};
    std::optional<Message> question = {};  ///< why there is no clock, though a column is a time
    std::vector<std::string> rivals = {};  ///< columns that are different clocks, in the file's order
    std::string variable = {};             ///< that holds the instants in seconds; empty without use_clock()
    bool likely = false;                   ///< the question is about a column that goes up as a time does
};

/// Decides which column holds the time of `samples` samples and what its numbers mean: the only place where this is
/// done. The column is `options.time`, or the one that is called a time (t, time_ms, Zeit, millis, ...) or holds times
/// of day or days, or else the only one with a unit of time. Its unit is `options.time_unit`, or that of the file, of
/// its name, or of the numbers: seconds or milliseconds since 1970, a spreadsheet's days, whole numbers of which only
/// one unit makes a likely sampling time or the one that the file states. Counters that wrap and times of day past
/// midnight go on. A question, and no clock, are given where two units are as likely, the instants do not increase, or
/// two columns are different clocks; neither, where no column is a time. Throws EnvironmentError for `options.time`
/// that is no column of numbers.
ClockSearch find_clock(const LoadedData& data, Index samples, const ImportOptions& options);

}  // namespace dynlab::inline data_io
