#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace dynlab::inline cli {

/// The page of man(1) for the program or one of its commands, in roff: what --help says, laid out as manuals are.
/// `name` as the page is called, such as "dynlab-run"; `version` as in "dynlab 0.1.0".
std::string manual_page(const CLI::App& command, const std::string& name, const std::string& version);

}  // namespace dynlab::inline cli
