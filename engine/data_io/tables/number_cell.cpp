#include "data_io/tables/number_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::array<std::string_view, 19> kMissingWords = {
    "nan",  "na",  "n/a",     "null",    "none",  "missing", "-",      "--",     "---", "?",
    "#n/a", "#na", "#div/0!", "#value!", "#num!", "#ref!",   "#null!", "#name?", "-nan"};

bool means_missing(std::string_view cell) {
    if (cell.empty()) return true;
    constexpr std::size_t kLongest = 8;
    if (cell.size() > kLongest) return false;
    const std::string word = in_small_letters(std::string(cell));
    return std::find(kMissingWords.begin(), kMissingWords.end(), word) != kMissingWords.end();
}

std::string shown(std::string_view given) {
    constexpr std::size_t kLongest = 40;
    given = trimmed_cell(given);
    return given.size() <= kLongest ? fmt::format("\"{}\"", given)
                                    : fmt::format("\"{}...\"", given.substr(0, kLongest));
}

}  // namespace

std::string_view trimmed_cell(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

NumberStatus parse_number(std::string_view cell, bool decimal_comma, double& number) {
    cell = trimmed_cell(cell);
    std::string_view digits = cell;
    char rewritten[64];
    const auto rewrite = [&](char from, char to) {
        if (digits.size() >= sizeof rewritten) return;
        std::replace_copy(digits.begin(), digits.end(), rewritten, from, to);
        digits = {rewritten, digits.size()};
    };
    if (decimal_comma && digits.find(',') != std::string_view::npos && digits.find('.') == std::string_view::npos)
        rewrite(',', '.');
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    const auto read = [&] { return std::from_chars(digits.data(), digits.data() + digits.size(), number); };
    auto result = read();
    if (result.ec == std::errc() && result.ptr != digits.data() + digits.size() &&
        (*result.ptr == 'D' || *result.ptr == 'd')) {  // Fortran's double precision
        rewrite(*result.ptr, 'e');
        result = read();
    }
    if (result.ec == std::errc::invalid_argument || result.ptr != digits.data() + digits.size()) {
        number = std::numeric_limits<double>::quiet_NaN();
        return means_missing(cell) ? NumberStatus::kMissing : NumberStatus::kNotANumber;
    }
    if (result.ec == std::errc::result_out_of_range) return NumberStatus::kOutOfRange;
    if (std::isnan(number)) return NumberStatus::kMissing;
    return std::isfinite(number) ? NumberStatus::kNumber : NumberStatus::kNotFinite;
}

void refuse_cell(const CellPlace& place, std::string_view cell, bool decimal_comma) {
    const std::string file = place.file.string(), given = shown(cell);
    double number = 0;
    const NumberStatus status = parse_number(cell, decimal_comma, number);
    if (status == NumberStatus::kNotFinite)
        throw EnvironmentError(
            "{}, line {}, column {}: wanted a finite number, given {}; where a sample is missing, write nothing or NaN",
            file, place.line, place.column, given);
    if (status == NumberStatus::kOutOfRange)
        throw EnvironmentError("{}, line {}, column {}: wanted a number that fits double precision, given {}", file,
                               place.line, place.column, given);
    if (looks_grouped(cell))
        throw EnvironmentError(
            "{}, line {}, column {}: wanted a number, given {}; write it without a sign between the thousands", file,
            place.line, place.column, given);
    throw EnvironmentError(
        "{}, line {}, column {}: wanted a number, given {}; where a sample is missing, write nothing or NaN", file,
        place.line, place.column, given);
}

bool looks_grouped(std::string_view cell) {
    cell = trimmed_cell(cell);
    if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
    return cell.find_first_not_of("0123456789.,") == std::string_view::npos &&
           cell.find('.') != std::string_view::npos && cell.find(',') != std::string_view::npos;
}

}  // namespace dynlab::inline data_io
