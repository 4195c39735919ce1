#include "data_io/tables/unit_text.h"

#include <algorithm>
#include <array>

#include "data_io/tables/number_cell.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

struct TimeUnit {
    std::string_view name;
    double seconds;
};
constexpr std::array<TimeUnit, 22> kTimeUnits = {{{"s", 1},
                                                  {"sec", 1},
                                                  {"secs", 1},
                                                  {"second", 1},
                                                  {"seconds", 1},
                                                  {"ms", 1e-3},
                                                  {"msec", 1e-3},
                                                  {"millisecond", 1e-3},
                                                  {"milliseconds", 1e-3},
                                                  {"us", 1e-6},
                                                  {"\u00B5s", 1e-6},
                                                  {"\u03BCs", 1e-6},
                                                  {"ns", 1e-9},
                                                  {"min", 60},
                                                  {"mins", 60},
                                                  {"minute", 60},
                                                  {"minutes", 60},
                                                  {"h", 3600},
                                                  {"hr", 3600},
                                                  {"hour", 3600},
                                                  {"hours", 3600},
                                                  {"day", 86400}}};

/// Symbols that take SI prefixes.
constexpr std::array<std::string_view, 27> kSymbols = {"m",  "g",  "s",  "A",   "K",   "mol", "cd", "Hz",     "N",
                                                       "Pa", "J",  "W",  "C",   "V",   "F",   "S",  "T",      "Wb",
                                                       "H",  "lm", "lx", "rad", "bar", "l",   "L",  "\u03A9", "\u2126"};
constexpr std::array<std::string_view, 17> kPrefixes = {"",  "k", "M", "G", "T", "h", "da", "d",     "c",
                                                        "m", "u", "n", "p", "f", "a", "P",  "\u00B5"};
/// Symbols and names that take none.
constexpr std::array<std::string_view, 60> kWords = {
    "%",       "-",       "\u00B0", "\u00B0C", "\u2103", "\u00B0F", "deg",    "degC",   "degF",    "degree",
    "degrees", "celsius", "kelvin", "rpm",     "rps",    "rev",     "turn",   "turns",  "dB",      "ppm",
    "pH",      "Nm",      "VA",     "VAr",     "var",    "Wh",      "kWh",    "Ah",     "mAh",     "ohm",
    "Ohm",     "psi",     "atm",    "mmHg",    "inch",   "ft",      "sr",     "volt",   "volts",   "ampere",
    "amperes", "amp",     "amps",   "meter",   "meters", "metre",   "metres", "newton", "newtons", "pascal",
    "watt",    "watts",   "radian", "radians", "hertz",  "percent", "counts", "bit",    "bits",    "a.u."};

template <class Names>
bool is_one_of(const Names& names, std::string_view text) {
    return std::ranges::find(names, text) != names.end();
}

bool is_symbol(std::string_view text) {
    if (is_one_of(kWords, text) || seconds_of(text)) return true;
    const std::string lower = in_small_letters(std::string(text));
    if (lower.size() > 3 && is_one_of(kWords, lower)) return true;  // Volts
    return std::ranges::any_of(kPrefixes, [text](std::string_view prefix) {
        return text.starts_with(prefix) && is_one_of(kSymbols, text.substr(prefix.size()));
    });
}

/// The next factor of a product, without the signs between factors and its exponent.
std::string_view take_factor(std::string_view& rest) {
    constexpr std::string_view kBetween = "*/ .()";
    constexpr std::array<std::string_view, 3> kDots = {"\u00B7", "\u22C5", "\u00D7"};
    std::size_t size = 0;
    const auto at_dot = [&] {
        return std::ranges::any_of(kDots, [&](std::string_view dot) { return rest.substr(size).starts_with(dot); });
    };
    while (size < rest.size() && kBetween.find(rest[size]) == std::string_view::npos && !at_dot()) ++size;
    std::string_view factor = rest.substr(0, size);
    rest.remove_prefix(std::min(rest.size(), at_dot() ? size + kDots[0].size() : size + 1));
    constexpr std::array<std::string_view, 4> kRaised = {"\u00B2", "\u00B3", "\u00B9", "\u207B"};
    for (bool more = true; more;) {
        more = false;
        for (const std::string_view raised : kRaised)
            if (factor.ends_with(raised)) factor.remove_suffix(raised.size()), more = true;
    }
    const std::size_t exponent = factor.find_last_not_of("0123456789-+^");
    return exponent == std::string_view::npos ? factor : factor.substr(0, exponent + 1);
}

}  // namespace

std::string_view without_brackets(std::string_view text) {
    text = trimmed_cell(text);
    const bool both =
        text.size() > 2 && ((text.front() == '(' && text.back() == ')') || (text.front() == '[' && text.back() == ']'));
    return both ? trimmed_cell(text.substr(1, text.size() - 2)) : text;
}

bool is_unit(std::string_view text) {
    text = trimmed_cell(text);
    constexpr std::size_t kLongest = 24;
    if (text.empty() || text.size() > kLongest) return false;
    if (is_symbol(text)) return true;
    bool found = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view factor = take_factor(rest);
        if (factor.empty() || factor == "1") continue;
        if (!is_symbol(factor)) return false;
        found = true;
    }
    return found;
}

std::optional<double> seconds_of(std::string_view unit) {
    for (const TimeUnit& time : kTimeUnits)
        if (time.name == unit) return time.seconds;
    return std::nullopt;
}

NamedUnit split_unit(std::string_view header) {
    header = trimmed_cell(header);
    const auto all = [&] { return NamedUnit{std::string(header), {}}; };
    if (header.size() < 4 || (header.back() != ')' && header.back() != ']')) return all();
    const bool round = header.back() == ')';
    const std::size_t begin = round ? header.rfind('(') : header.rfind('[');
    if (begin == std::string_view::npos || begin == 0) return all();
    const std::string_view name = trimmed_cell(header.substr(0, begin));
    const std::string_view unit = trimmed_cell(header.substr(begin + 1, header.size() - begin - 2));
    double number = 0;
    const bool accepted =
        round ? is_unit(unit) : !unit.empty() && parse_number(unit, true, number) == NumberStatus::kNotANumber;
    return name.empty() || !accepted ? all() : NamedUnit{std::string(name), std::string(unit)};
}

}  // namespace dynlab::inline data_io
