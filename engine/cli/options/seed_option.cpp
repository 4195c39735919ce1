#include "cli/options/seed_option.h"

#include <charconv>
#include <iostream>
#include <random>

namespace dynlab::inline cli {
namespace {

std::optional<std::uint32_t> parse_seed(const std::string& text) {
    std::uint32_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return seed;
}

}  // namespace

void SeedOption::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        if (given == "random" || parse_seed(given)) return {};
        return "wanted a whole number from 0 to 4294967295 or the word random, not '" + given + "'";
    };
    command.add_option("--seed", text, "Seed of the random numbers instead of the script's, or the word random")
        ->type_name("N|random")
        ->check(CLI::Validator(check, ""));
}

std::optional<std::uint32_t> SeedOption::value() const {
    if (text.empty()) return std::nullopt;
    if (text != "random") return parse_seed(text);
    const auto seed = static_cast<std::uint32_t>(std::random_device{}());
    std::cerr << "seed " << seed << " (repeat this run with --seed " << seed << ")\n";
    return seed;
}

}  // namespace dynlab::inline cli
