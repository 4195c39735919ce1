#include "cli/options/seed_option.h"

#include <iostream>
#include <random>

#include "platform/text/read_number.h"

namespace dynlab::inline cli {

void SeedOption::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        if (given == "random" || read_number<std::uint32_t>(given)) return {};
        return "wanted a whole number from 0 to 4294967295 or the word random, not '" + given + "'";
    };
    command.add_option("--seed", text, "Seed of the random numbers instead of the script's, or the word random")
        ->type_name("N|random")
        ->check(CLI::Validator(check, ""));
}

std::optional<std::uint32_t> SeedOption::value() const {
    if (text.empty()) return std::nullopt;
    if (text != "random") return read_number<std::uint32_t>(text);
    const auto seed = static_cast<std::uint32_t>(std::random_device{}());
    std::cerr << "seed " << seed << " (repeat this run with --seed " << seed << ")\n";
    return seed;
}

}  // namespace dynlab::inline cli
