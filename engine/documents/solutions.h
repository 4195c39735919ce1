#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline documents {

/// Reference solutions inside a literate script. In a code or a text cell,
///
///     -- BEGIN SOLUTION
///     local K = dy/du
///     -- STARTER: local K = 1    (what the student's copy starts from, so that it runs)
///     -- END SOLUTION
///
/// encloses the part that a student must find. In the student's copy, `-- YOUR CODE HERE` (in a text cell `-- *Your
/// answer:*`; both in the copy's language) replaces the solution, followed by the STARTER lines without their sign:
/// code in a code cell, text in a text cell. Documents never show markers or STARTER lines.
enum class SolutionLine { kNone, kBegin, kEnd, kStarter };

/// What a line of a script is. Throws DocumentError for a line that is nearly a marker (wrong case, plural), which
/// would otherwise give the solution away.
SolutionLine solution_line(std::string_view line, const std::filesystem::path& file, int number);

/// The lines that ask for an answer, in French for "fr".
struct AnswerMarks {
    std::string code, text;
};
AnswerMarks answer_marks(std::string_view language);

/// The script without its solutions, everything else byte for byte, but for texts in two languages: where the script
/// begins with `local function say(english, french)`, a call of it with two texts becomes the one in the copy's
/// language, and the function is left out. In a code cell with echo=false nothing takes the
/// place of a solution, since such cells hold only what the report needs, and solutions of code with nothing between
/// them are asked for once. Throws DocumentError with file and line for
/// markers that do not pair up within one cell, or a STARTER line outside a solution.
std::string without_solutions(const std::string& source, const std::filesystem::path& name = "script.lua",
                              std::string_view language = "en");

}  // namespace dynlab::inline documents
