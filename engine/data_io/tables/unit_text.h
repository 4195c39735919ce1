#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline data_io {

/// Whether a text is a unit of measurement: products, quotients and powers of SI symbols with their prefixes and of
/// others that records use (deg C, rpm, bar, %, ...), or such a unit's English name.
bool is_unit(std::string_view text);

/// Seconds that the unit stands for; nothing for what is no unit of time.
std::optional<double> seconds_of(std::string_view unit);

/// Without a pair of brackets around it.
std::string_view without_brackets(std::string_view text);

struct NamedUnit {
    std::string name, unit;  ///< unit empty: the header is all name
};
/// Takes a header as "speed (m/s)" or "u [V]" apart. In round brackets only what is_unit() is taken for a unit, in
/// square ones all but numbers.
NamedUnit split_unit(std::string_view header);

}  // namespace dynlab::inline data_io
