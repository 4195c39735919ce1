#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "documents/complaints.h"
#include "documents/run_record.h"

namespace dynlab::inline documents {

/// A picture the document shows: the filter gave it a number and wrote `file_name` into the output.
struct UsedPicture {
    int number = 0;
    bool is_figure = false;  ///< a figure of the run results, else a file
    std::string name;        ///< of the figure, or the path as written
};

/// How many figures, tables, equations and sections of each level have been counted at one place of a document.
using Counts = std::array<int, 10>;

/// The filter's messages about the pieces of a document that is set in chunks, by their numbers.
struct ChunkMessages {
    std::map<int, Counts> begin, end;
    std::map<int, std::map<std::string, std::string>> labels;  ///< defined there: label -> what references show
};

/// What our Pandoc filter and Pandoc itself wrote on standard error.
struct FilterMessages {
    std::vector<UsedPicture> pictures;
    ChunkMessages chunks;
    Complaints gaps;  ///< what a draft shows as ??: references and slots with nothing behind them
};

/// Adds a sentence with its line in the source for every error of the filter and every warning of Pandoc.
FilterMessages read_filter_messages(const std::string& error_output, const MarkdownText& markdown,
                                    const std::filesystem::path& template_file, const RunRecord& record,
                                    Complaints& complaints);

}  // namespace dynlab::inline documents
