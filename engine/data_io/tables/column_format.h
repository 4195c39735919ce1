#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data_io/tables/clock_cell.h"
#include "data_io/tables/number_cell.h"

namespace dynlab::inline data_io {

/// How all cells of a column are written, decided from the first some hundred.
struct ColumnFormat {
    enum class Kind {
        kNumber,
        kMeasure,  ///< numbers with their unit: 12.5 %, 3.2 V
        kSwitch,   ///< ON and OFF, true and false, ...: 1 and 0
        kClock,    ///< times of day, or days
        kText,
    };
    Kind kind = Kind::kNumber;
    char thousands = 0;             ///< comma or point between the thousands; any blank or ' may be there, too
    std::string unit = {};          ///< of kMeasure
    std::string on = {}, off = {};  ///< of kSwitch, as they are in the file; one of them may be empty
    std::string example = {};       ///< a cell that is written so
};

/// One format for each column of `rows`, whose cells are separated by `separator`.
std::vector<ColumnFormat> formats_of(std::span<const std::vector<std::string>* const> rows, std::size_t columns,
                                     char separator);

/// A column's clocks: what must be known of all cells before their numbers mean something.
struct ClockForms {
    bool two_fields = false, day_first = false, month_first = false, either_first = false;
    bool dated = false;  ///< days, not times of day
};

/// Reads a cell of a column of numbers in whatever form; a switch gives 1 or 0, a clock seconds.
NumberStatus read_cell(const ColumnFormat& format, std::string_view cell, double& number, ClockForms& clocks);

/// Whether a cell is no plain number, but a number with thousands or a unit, a time or a day.
bool is_number_in_disguise(std::string_view cell);

/// The place of a cell, for messages.
struct CellPlace {
    const std::filesystem::path& file;
    std::size_t line;
    const std::string& column;  ///< its name
};

/// Throws EnvironmentError for a cell that is not written as its column: says what is wrong with it, and what to write.
[[noreturn]] void refuse_cell(const CellPlace& place, std::string_view cell, const ColumnFormat& format);

}  // namespace dynlab::inline data_io
