#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Whether a text is a unit of measurement: products, quotients and powers of SI symbols with their prefixes and of
/// other common symbols (deg C, rpm, bar, %, ...), or such a unit's English name.
bool is_unit(std::string_view text);

/// Without a pair of brackets around it.
std::string_view without_brackets(std::string_view text);

struct NamedUnit {
    std::string name, unit;  ///< unit empty: the header is all name
};
/// Takes a header as "speed (m/s)", "u [V]" or "C1 in V" apart. In square brackets any text but a number is a unit;
/// otherwise is_unit() decides, or, behind the name of a time, seconds_of().
NamedUnit split_unit(std::string_view header);

}  // namespace dynlab::inline data_io
