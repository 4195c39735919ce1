#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace dynlab::inline cli {

/// --on, --spool and --lease of commands whose work others may do (workflow/shares).
void add_share_options(CLI::App& command, std::string& on, std::string& spool, int& lease);

}  // namespace dynlab::inline cli
