#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "documents/text_lines.h"
#include "support/program.h"

namespace dynlab::test {

/// How much of a page's text height, in cm, nothing is printed on at its end, for every page of an A4 document as
/// pdftoppm draws it. The foot with the page's number does not count.
inline std::vector<double> white_page_ends(const Workbench& bench, const std::string& file) {
    constexpr int kDotsPerInch = 40, kInk = 200;
    constexpr double kEndOfText = 27.1;  // cm from the upper edge
    const double lines_per_cm = kDotsPerInch / 2.54;
    const ChildResult drawn = bench.shell("pdftoppm -gray -r " + std::to_string(kDotsPerInch) + " '" + file + "'");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.error_output;
    std::vector<double> ends;
    std::istringstream pages(drawn.output);
    std::string kind;
    std::size_t width = 0, height = 0, greys = 0;
    while (pages >> kind >> width >> height >> greys) {
        pages.get();
        std::string grey(width * height, '\0');
        pages.read(grey.data(), static_cast<std::streamsize>(grey.size()));
        const auto end = static_cast<std::size_t>(kEndOfText * lines_per_cm);
        std::size_t last = std::min(end, height);
        const auto has_ink = [&](std::size_t line) {
            const auto begin = grey.begin() + static_cast<std::ptrdiff_t>(line * width);
            return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(width),
                               [](char value) { return static_cast<unsigned char>(value) < kInk; });
        };
        while (last > 0 && !has_ink(last - 1)) --last;
        ends.push_back(static_cast<double>(end - last) / lines_per_cm);
    }
    return ends;
}

/// The titles of the sections of a Markdown file or of the text cells of a lesson.
inline std::vector<std::string> section_titles(const std::string& source) {
    std::vector<std::string> titles;
    for (std::string line : lines_of(source)) {
        if (line.starts_with("-- ")) line = line.substr(3);
        if (line.starts_with("# ")) titles.push_back(trimmed(line.substr(2, line.find('{') - 2)));
    }
    return titles;
}

/// No page ends with more than 3 cm of white, except before a section: 4 cm if the figures of the last section come
/// first on the next page, more if the heading does. The document's last page may end anywhere.
inline void expect_full_pages(const Workbench& bench, const std::string& file,
                              const std::vector<std::string>& section_titles) {
    const std::vector<double> ends = white_page_ends(bench, file);
    ASSERT_FALSE(ends.empty());
    std::istringstream text(bench.shell("pdftotext '" + file + "' -").output);
    std::string next;
    std::getline(text, next, '\f');
    for (std::size_t page = 0; page + 1 < ends.size(); ++page) {
        ASSERT_TRUE(std::getline(text, next, '\f')) << file;
        next = trimmed(next);
        double max_distance = 3;
        for (const std::string& title : section_titles) {
            const std::size_t at = next.find(title);
            if (at < next.find('\n')) max_distance = 30;
            if (at != std::string::npos) max_distance = std::max(max_distance, 4.0);
        }
        EXPECT_LE(ends[page], max_distance) << file << ", page " << page + 1;
    }
}

}  // namespace dynlab::test
