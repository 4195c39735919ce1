#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/message.h"
#include "base/reader.h"

namespace dynlab::inline figures {
struct Figure;
}

namespace dynlab::inline documents {

/// `report.value`: a number with the text that documents show, or a text.
struct RecordedValue {
    std::optional<double> number;
    std::string text;  ///< formatted; plain text, never Markdown
};

/// `report.table`: a header row and rows of plain text cells. Columns whose cells are all numbers are set
/// right-aligned.
struct RecordedTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

/// `report.figure`, or a figure a cell made and dropped (then `name` is "<cell id>-figure-K" and the caption
/// is the figure's title).
struct RecordedFigure {
    std::shared_ptr<const Figure> figure;  ///< null in run results that were read from a file
    std::string caption;                   ///< Markdown, read as safely as a template
    std::filesystem::path file;            ///< where it was drawn, once it was
    std::size_t order = 0;                 ///< in the order in which the script made its figures
    std::string plot = {};  ///< what a page draws it from (documents/html/plot_data.h), where it was drawn for one
    std::string axes = {};  ///< words_of_axes(), which stay where the figure itself is not kept
};

/// `report.text`: Markdown written by the script.
struct RecordedText {
    std::string markdown;
};

/// One piece of what a code cell produced, in the order it was produced.
struct CellOutput {
    std::string printed;                ///< text printed since the piece before
    std::optional<std::string> figure;  ///< name of a captured figure
};

/// `slider`: a number that the user who runs the script may choose.
struct RecordedSlider {
    double value = 0, initial = 0;  ///< what this run had; what the script says
    double from = 0, to = 0;
    std::optional<double> step;  ///< none: any number between
    bool logarithmic = false;    ///< its places are spread evenly over the logarithm
    std::string label, unit;     ///< plain text
    std::string cell;            ///< id of the cell that asked for it first
    std::size_t order = 0;       ///< in the order in which the script asked
};

/// A call on the way to an error.
struct RecordedCall {
    Message what;      ///< "called gain(x = 2)"
    std::string file;  ///< file name of the place, without folders
    int line = 0;
};

/// An error of the script. Its options have their script names for every reader.
struct RecordedError {
    Message message;                       ///< without its place
    std::string file = {};                 ///< where it happened, without folders; empty when unknown
    int line = 0;                          ///< of that file
    std::vector<RecordedCall> calls = {};  ///< of the script's own functions, the innermost first

    /// As Lua has it: "lesson.lua:3: there is no function or variable 'y'".
    std::string text(const Reader& reader = {}) const;
    /// The line, where it is one of that script; else 0.
    int line_in(const std::string& script) const { return file == script ? line : 0; }
};

/// `answer`: a named answer of the script.
struct RecordedAnswer {
    std::string kind;  ///< one of answer_kinds()
    std::string json;  ///< as push_answer_value reads it again
};

/// Everything a run of a script produced: the one thing documents are made from.
struct RunRecord {
    std::string script;  ///< file name without folders
    std::uint32_t seed = 1;
    std::map<std::string, RecordedValue> values;
    std::map<std::string, RecordedTable> tables;
    std::map<std::string, RecordedFigure> figures;
    std::map<std::string, RecordedText> texts;
    std::map<std::string, RecordedAnswer> answers;
    std::map<std::string, RecordedSlider> sliders;
    std::map<std::string, std::vector<CellOutput>> outputs;  ///< by cell id, in the order produced
    std::optional<RecordedError> error;                      ///< the run stopped here
    std::vector<std::filesystem::path> files_read;           ///< data files, in the order first read
    std::map<std::string, double> timings;                   ///< seconds by cell id; never part of to_json
};

/// JSON text (UTF-8, keys sorted, numbers with 17 digits) without timings, so that equal runs give equal
/// bytes.
std::string to_json(const RunRecord& record);
/// The run results that to_json wrote, without the parts that it leaves out. Throws ValueError for any other text.
RunRecord record_from_json(const std::string& json);

}  // namespace dynlab::inline documents
