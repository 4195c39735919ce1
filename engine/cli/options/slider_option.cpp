#include "cli/options/slider_option.h"

#include <cmath>
#include <optional>

#include "platform/text/read_number.h"

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

void SliderOption::add_to(CLI::App& command) {
    const auto check = [](const std::string& given) -> std::string {
        if (parse_setting(given)) return {};
        return "wanted a slider's name and a number, such as lambda=3, not '" + given + "'";
    };
    command.add_option("--set", texts, "The number of a slider of the script; for each slider")
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
