#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline documents {

/// The kind of value a script promises under a name in its header's `answers`.
struct ExpectedAnswer {
    std::string name, kind;
};

/// number, text, truth, vector, matrix, data, model, table.
const std::vector<std::string>& answer_kinds();

/// The comment header of a literate script: lines `-- key: value` between two `-- ---` lines.
struct ScriptHeader {
    std::string title, lesson, subtitle;
    std::string template_name = "lesson";
    std::string language = "en";  ///< "en" or "fr"
    std::uint32_t seed = 1;
    std::vector<ExpectedAnswer> answers;
    std::string bibliography;  ///< name of a file beside the script, or empty
};

struct Cell {
    enum class Kind { kText, kCode };
    Kind kind = Kind::kCode;
    std::string id;                              ///< from `-- %% id=q2`, else "cell-N"
    std::string repeats;                         ///< the id of its marker, where an earlier cell has it
    std::map<std::string, std::string> options;  ///< further key=value pairs; echo=false, output=false are known
    int first_line = 1;                          ///< 1-based line of the cell's first content line in the script
    std::string content;                         ///< text cells: Markdown with the comment signs taken off
    int last_line() const;
};

/// A Lua script in the percent format: `-- %% [markdown]` starts a text cell (Lua comment lines), `-- %%` a
/// code cell.
/// `-- BEGIN SOLUTION` ... `-- END SOLUTION` enclose what a student's copy must not contain; the marker lines
/// themselves are never shown.
struct PercentScript {
    std::filesystem::path file;
    ScriptHeader header;
    std::vector<Cell> cells;
    std::string source;  ///< the whole file, unchanged: what Lua runs

    const Cell* cell_at_line(int line) const;
};

/// Throws DocumentError with file and line: unknown or malformed header key (suggesting the nearest), header
/// not closed, unknown cell option, a text cell line that is not a comment, solution
/// markers that do not pair up.
PercentScript read_percent_script(const std::filesystem::path& file);
/// The file that the header names, beside the script; empty where it names none.
std::filesystem::path bibliography_of(const PercentScript& script);
PercentScript parse_percent_script(const std::string& source, const std::filesystem::path& name);

bool is_cell_marker(std::string_view line);                   ///< `-- %%` and its options
bool is_text_cell_marker(std::string_view line);              ///< `-- %% [markdown]` and its options
std::string_view cell_marker_options(std::string_view line);  ///< what follows `-- %%`

}  // namespace dynlab::inline documents
