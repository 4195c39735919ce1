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

/// Recognizes exports of LabVIEW (.lvm), Tektronix and Rigol oscilloscopes and Arduino's serial monitor, overwrites
/// text in `text` outside the table with blanks, and returns its information. The text keeps its length and its lines.
/// Exports of other instruments are tables with lines above them. Throws EnvironmentError with the line for a LabVIEW
/// file of several data sets.
InstrumentFacts take_instrument_text(const std::filesystem::path& file, std::string& text);

}  // namespace dynlab::inline data_io
