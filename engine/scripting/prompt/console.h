#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

#include "scripting/prompt/prompt_session.h"

namespace dynlab::inline scripting {

/// The prompt on the terminal (standard input and output): reads statements, one line or several, until Ctrl-D or quit.
/// An error or Ctrl-C ends the statement, not the prompt. Expects an InterruptScope. `first`: a statement to run first,
/// unless empty. `see` gets each figure, in addition to its file.
void run_prompt(const std::filesystem::path& figure_folder, const std::string& greeting, const std::string& first,
                const FigureListener& see);

/// The same for statements that come from a pipe or file, without prompts and colors: values and the paths of figures
/// go to standard output, errors with the line of the input to standard error. After an error the next statement runs.
/// Returns whether all went well. Ctrl-C throws Interrupted.
bool run_statements_of(std::istream& input, const std::filesystem::path& figure_folder, const FigureListener& see);

}  // namespace dynlab::inline scripting
