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
    Message message;           ///< in the words in which a run would tell it
};

/// What scripts may use without having made it: each name with its members where it is a table.
using LibraryNames = std::map<std::string, std::vector<std::string>>;
const LibraryNames& library_names();

/// What is wrong with a script, in the order of its lines: text that is no Lua, names that nothing defines, functions
/// of dynlab that are given another value, options that a function does not know, answers that the header does not
/// declare, or declares and that are never handed in. `file` names the script in messages; it is not read.
/// `more_names`: functions of a later layer, as files with checks call them.
std::vector<LintIssue> lint_script(const std::string& source, const std::filesystem::path& file,
                                   const std::vector<std::string>& more_names = {});

}  // namespace dynlab::inline scripting
