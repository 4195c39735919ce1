#pragma once
#include <string>

#include "base/reader.h"
#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline documents {

/// Markdown with the origin of every line.
struct MarkdownText {
    std::string text;
    std::vector<Place> origin;  ///< one per line of text

    void append(const std::string& lines, const std::filesystem::path& file, int first_line);
    Place origin_of(int line) const;  ///< 1-based
};

/// The script's cells in reading order: text, code, printed output, captured figures. Solution markers are
/// left out; a recorded error appears at its cell.
MarkdownText weave_cells(const PercentScript& script, const RunRecord& record);

/// The labels of a figure's axes, as Markdown for the reader, used as a caption if the script gives none: "y (m), u (V)
/// over time (s)"; empty if the axes have no labels.
std::string words_of_axes(const Figure& figure, const Reader& reader);

/// A block that shows an error's message.
std::string error_block(const std::string& message);

}  // namespace dynlab::inline documents
