#pragma once
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "documents/text_lines.h"
#include "support/program.h"

namespace dynlab::test {

/// No line of a PDF's text ends with a number whose unit begins the next line. Oracle: the lines as poppler reads them.
inline void expect_whole_quantities(const Workbench& bench, const std::string& file) {
    static const std::regex kNumber(R"((\S+\s+){3}.*\d$)");  // behind other words: no cell of a table, no axis
    static const std::regex kUnit(R"(^((c|m|µ|k)?(m|s|g|N|V|W|rad|Hz)|°C|dB|%)((/|·)\S*)?[.,;:!?)]*(\s|$))");
    const std::vector<std::string> lines = lines_of(bench.shell("pdftotext '" + file + "' -").output);
    EXPECT_FALSE(lines.empty()) << file;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        EXPECT_FALSE(std::regex_search(lines[i], kNumber) && std::regex_search(lines[i + 1], kUnit))
            << file << ": " << lines[i] << " | " << lines[i + 1];
}

}  // namespace dynlab::test
