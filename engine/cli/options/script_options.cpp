#include "cli/options/script_options.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <set>

#include "base/languages.h"
#include "cli/say.h"
#include "platform/terminal/terminal_text.h"
#include "platform/text/read_number.h"
#include "workflow/given_script.h"

namespace dynlab::inline cli {
namespace {

std::optional<std::pair<std::string, double>> parse_setting(const std::string& text) {
    const std::size_t sign = text.find('=');
    if (sign == 0 || sign == std::string::npos) return std::nullopt;
    const auto value = read_number<double>(text.substr(sign + 1));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    return std::pair{text.substr(0, sign), *value};
}

}  // namespace

void expect_script(const std::string& given, const std::string& command) {
    speak(language_of_work(given));
    if (const Message why = why_no_script(given, command); !why.empty())
        throw CLI::ValidationError(message_text(why, user()));
}

void use_current_folder_by_default(std::string& subject, const std::string& command) {
    namespace fs = std::filesystem;
    if (!subject.empty()) return;
    std::error_code none;
    if (fs::is_regular_file("analysis.lua", none)) {
        subject = ".";
        return;
    }
    std::set<std::string> works;
    for (const auto& entry : fs::directory_iterator(".", none))
        if (fs::is_regular_file(entry.path() / "analysis.lua", none)) works.insert(entry.path().filename().string());
    throw CLI::ValidationError(
        message_text(Message("specify a folder or a script, for example: dynlab {} {}", command,
                             works.empty() ? std::string("my-work") : shell_word(*works.begin())),
                     user()));
}

CLI::Option* add_language(CLI::App& command, std::string& language, const std::string& help) {
    return command.add_option("--lang", language, help)->check(CLI::IsMember(languages()))->each(speak);
}

void SeedOption::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        if (given == "random" || read_number<std::uint32_t>(given)) return {};
        return "expected a whole number from 0 to 4294967295 or the word random, not '" + given + "'";
    };
    command.add_option("--seed", text, "Seed of the random numbers, instead of the script's, or the word random")
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

void SliderOption::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        if (parse_setting(given)) return {};
        return "expected a slider's name and a number, such as lambda=3, not '" + given + "'";
    };
    command.add_option("--set", texts, "Value of a slider of the script; may be repeated")
        ->type_name("NAME=NUMBER")
        ->expected(1)
        ->take_all()
        ->check(CLI::Validator(check, ""));
}

std::map<std::string, double> SliderOption::values() const {
    std::map<std::string, double> values;
    for (const std::string& text : texts)
        if (const auto setting = parse_setting(text)) values[setting->first] = setting->second;
    return values;
}

}  // namespace dynlab::inline cli
