#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline data_io {

/// What the user says of a data file instead of having it guessed.
struct ImportOptions {
    std::size_t skip = 0;                           ///< lines of a text that are passed over, counted from its first
    std::vector<std::string> names = {};            ///< of all columns, instead of the file's
    std::optional<char> delimiter = {};             ///< between cells; ' ' means any number of blanks and tabs
    std::map<std::string, std::string> units = {};  ///< by column, instead of the file's
    std::string time = {};                          ///< name of the column of instants
    std::string time_unit = {};                     ///< of that column, or of the one that is found
    std::string sheet = {};                         ///< of a workbook; default: its first one
};

}  // namespace dynlab::inline data_io
