#pragma once
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace dynlab::test {

/// Rows of a comma-separated file of tests/reference/data, header included, as text.
inline std::vector<std::vector<std::string>> reference_rows(const std::string& file) {
    const std::string path = std::string(DYNLAB_SOURCE_DIR) + "/tests/reference/data/" + file;
    std::ifstream stream(path);
    if (!stream) throw std::runtime_error("cannot read " + path);
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
        rows.push_back(row);
    }
    return rows;
}

/// The same as columns of numbers by header.
inline std::map<std::string, std::vector<double>> reference_columns(const std::string& file) {
    const auto rows = reference_rows(file);
    std::map<std::string, std::vector<double>> columns;
    for (std::size_t j = 0; j < rows.front().size(); ++j)
        for (std::size_t i = 1; i < rows.size(); ++i) columns[rows.front()[j]].push_back(std::stod(rows[i][j]));
    return columns;
}

}  // namespace dynlab::test
