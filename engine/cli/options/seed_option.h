#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace dynlab::inline cli {

/// The option `--seed N|random`.
struct SeedOption {
    std::string text;

    void add_to(CLI::App& command);
    /// The number asked for; with "random" one from the system, told on standard error. Nothing when not given.
    std::optional<std::uint32_t> value() const;
};

}  // namespace dynlab::inline cli
