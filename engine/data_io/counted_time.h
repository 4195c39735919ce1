#pragma once
#include <optional>
#include <span>

#include "numerics/linalg/types.h"

namespace dynlab::inline data_io {

/// The usual distance of numbers that go up; 0 where none does.
double median_step(const Vector& values);

/// The last decimal place with which numbers are written, 1 for whole ones; 0 beyond nine decimals.
double quantum_of(const Vector& values);

/// Adds what a counter loses each time it begins again, after one of `ranges`. Returns after which, 0 where it does not
/// wrap.
double count_on(Vector& values, std::span<const double> ranges);

struct TimeUnitOfNumbers {
    double seconds;
    const char* name;
};

/// What the numbers of a column without a unit count.
struct Counted {
    TimeUnitOfNumbers unit;
    bool calendar = false;                        ///< since a day long ago
    bool assumed = false;                         ///< worth a word
    std::optional<TimeUnitOfNumbers> rival = {};  ///< as likely
};
/// Finds the unit of numbers without a stated unit, from their size and steps. `Ts`: sampling time that the file
/// states; `is_called_time`: the column's name means time.
Counted counted_unit(const Vector& values, std::optional<double> Ts, bool is_called_time);

}  // namespace dynlab::inline data_io
