#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace dynlab::inline cli {

/// What is wrong with the words of the command line, in the style of the other messages, and how to get on. For a
/// command or an option that there is not, the nearest name is suggested.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace dynlab::inline cli
