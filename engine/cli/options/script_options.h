#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// For the script or folder argument of a command: from here on dynlab prints in the script's language. Throws the
/// parser's error, before anything is written, for a file whose ending shows that it is no script
/// (workflow/given_script.h).
void expect_script(const std::string& given, const std::string& command);

/// Without an argument, a command works on the current folder if it contains an analysis.lua. Throws the parser's error
/// with an example otherwise.
void use_current_folder_by_default(std::string& subject, const std::string& command);

/// The option `--lang CODE`, which is the language of the program's messages, too.
CLI::Option* add_language(CLI::App& command, std::string& language, const std::string& help);

/// The option `--seed N|random`.
struct SeedOption {
    std::string text;

    void add_to(CLI::App& command);
    /// The requested number; with "random" one from the system, printed on standard error. Nothing if not given.
    std::optional<std::uint32_t> value() const;
};

/// The option `--set NAME=NUMBER`, which may be given for each slider of the script.
struct SliderOption {
    std::vector<std::string> texts;

    void add_to(CLI::App& command);
    std::map<std::string, double> values() const;
};

}  // namespace dynlab::inline cli
