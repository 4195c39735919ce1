#pragma once
#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline cli {

/// The option `--set NAME=NUMBER`, which may be given for each slider of the script.
struct SliderOption {
    std::vector<std::string> texts;

    void add_to(CLI::App& command);
    std::map<std::string, double> values() const;
};

}  // namespace dynlab::inline cli
