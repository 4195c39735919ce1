#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline scripting {

/// Something in a script that will not work, found without running it.
struct LintIssue {
    int line = 1, column = 1;  ///< from 1; columns count characters, not bytes
    std::string kind;          ///< "syntax", "header", "unknown-name", "unknown-option", ...
    Message message;           ///< the message that a run would print
};

/// What scripts may use without having made it: each name with its members where it is a table.
using LibraryNames = std::map<std::string, std::vector<std::string>>;
const LibraryNames& library_names();

/// Checks a script and returns the issues in the order of its lines: text that is not Lua, undefined names, functions
/// of dynlab that are assigned another value, options that a function does not know, answers that the header does not
/// declare, and declared answers that the script never gives. `file` names the script in messages; the function does
/// not read it. `more_names`: functions of a later layer, for example those that files with checks call.
std::vector<LintIssue> lint_script(const std::string& source, const std::filesystem::path& file,
                                   const std::vector<std::string>& more_names = {});

}  // namespace dynlab::inline scripting
