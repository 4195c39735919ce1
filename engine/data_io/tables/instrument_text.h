#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline data_io {

/// What an instrument's export says outside its table.
struct InstrumentFacts {
    std::vector<std::string> names = {};            ///< of all columns; none when the table names them
    std::map<std::string, std::string> units = {};  ///< by column
    std::string counter = {};                       ///< column that counts samples: start + number * Ts is the time
    double start = 0;                               ///< s
    std::optional<double> Ts = {};                  ///< s
};

/// Finds the exports of LabVIEW (.lvm), Tektronix and Rigol oscilloscopes and Arduino's serial monitor, blanks in
/// `text` what does not belong to the table, and returns what it said. The text keeps its length and its lines. Exports
/// of others are tables with lines above them. Throws EnvironmentError with the line for a LabVIEW file of several
/// records.
InstrumentFacts take_instrument_text(const std::filesystem::path& file, std::string& text);

}  // namespace dynlab::inline data_io
