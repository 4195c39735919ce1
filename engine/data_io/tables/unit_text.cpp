#include "data_io/tables/unit_text.h"

#include <algorithm>
#include <array>

#include "data_io/tables/number_cell.h"
#include "data_io/tables/time_text.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

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
    "amperes", "amp",     "amps",   "metre",   "metres", "meter",   "meters", "newton", "newtons", "pascal",
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
    constexpr std::size_t kMaxLength = 24;
    if (text.empty() || text.size() > kMaxLength) return false;
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

NamedUnit split_unit(std::string_view header) {
    header = trimmed_cell(header);
    const auto all = [&] { return NamedUnit{std::string(header), {}}; };
    constexpr std::string_view kIn = " in ";
    if (const auto in = header.rfind(kIn); in != std::string_view::npos && is_unit(header.substr(in + kIn.size())))
        return {std::string(trimmed_cell(header.substr(0, in))),
                std::string(trimmed_cell(header.substr(in + kIn.size())))};
    constexpr std::string_view kClosing = ")]}", kOpening = "([{";
    const std::size_t kind = header.size() < 4 ? std::string_view::npos : kClosing.find(header.back());
    if (kind == std::string_view::npos) return all();
    const std::size_t begin = header.rfind(kOpening[kind]);
    if (begin == std::string_view::npos || begin == 0) return all();
    const std::string_view name = trimmed_cell(header.substr(0, begin));
    const std::string_view unit = trimmed_cell(header.substr(begin + 1, header.size() - begin - 2));
    double number = 0;
    const bool square = kOpening[kind] == '[';
    const bool accepted = square ? !unit.empty() && parse_number(unit, number) == NumberStatus::kNotANumber
                                 : is_unit(unit) || (time_name_of(name).is_time && seconds_of(unit, true));
    return name.empty() || !accepted ? all() : NamedUnit{std::string(name), std::string(unit)};
}

}  // namespace dynlab::inline data_io
