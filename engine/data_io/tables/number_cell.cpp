#include "data_io/tables/number_cell.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

constexpr std::array<std::string_view, 20> kMissingWords = {
    "nan", "na",   "n/a", "null",    "none",    "missing", "-",     "--",     "---",    "?",
    ".",   "#n/a", "#na", "#div/0!", "#value!", "#num!",   "#ref!", "#null!", "#name?", "-nan"};

bool means_missing(std::string_view cell) {
    if (cell.empty()) return true;
    constexpr std::size_t kMaxLength = 8;
    if (cell.size() > kMaxLength) return false;
    const std::string word = in_small_letters(std::string(cell));
    return std::find(kMissingWords.begin(), kMissingWords.end(), word) != kMissingWords.end();
}

}  // namespace

std::string_view trimmed_cell(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

NumberStatus parse_number(std::string_view cell, double& number) {
    cell = trimmed_cell(cell);
    std::string_view digits = cell;
    char rewritten[64];
    const auto rewrite = [&](char from, char to) {
        if (digits.size() >= sizeof rewritten) return;
        std::replace_copy(digits.begin(), digits.end(), rewritten, from, to);
        digits = {rewritten, digits.size()};
    };
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    const auto read = [&] { return std::from_chars(digits.data(), digits.data() + digits.size(), number); };
    auto result = read();
    const auto is_read = [&] { return result.ptr == digits.data() + digits.size(); };
    if (!is_read() && digits.find(',') != std::string_view::npos && digits.find('.') == std::string_view::npos) {
        rewrite(',', '.');
        result = read();
    }
    if (result.ec == std::errc() && !is_read() && (*result.ptr == 'D' || *result.ptr == 'd')) {
        rewrite(*result.ptr, 'e');  // Fortran's double precision
        result = read();
    }
    if (result.ec == std::errc::invalid_argument || !is_read()) {
        number = std::numeric_limits<double>::quiet_NaN();
        if (cell.ends_with("\u221E")) return NumberStatus::kNotFinite;  // oscilloscopes, beyond their range
        return means_missing(cell) ? NumberStatus::kMissing : NumberStatus::kNotANumber;
    }
    if (result.ec == std::errc::result_out_of_range) return NumberStatus::kOutOfRange;
    if (std::isnan(number)) return NumberStatus::kMissing;
    return std::isfinite(number) ? NumberStatus::kNumber : NumberStatus::kNotFinite;
}

std::optional<GroupedNumber> grouped_number(std::string_view cell) {
    constexpr std::array<std::string_view, 8> kSigns = {",", ".", "'", " ", "\u2019", "\u00A0", "\u2009", "\u202F"};
    cell = trimmed_cell(cell);
    constexpr std::size_t kMaxLength = 60, kThousand = 3;
    if (cell.size() > kMaxLength) return std::nullopt;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::string plain;
    if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) {
        if (cell.front() == '-') plain += '-';
        cell.remove_prefix(1);
    }
    std::size_t digits = 0;
    while (digits < cell.size() && is_digit(cell[digits])) ++digits;
    const bool begins = digits > 0 && digits <= kThousand && cell.front() != '0';
    const std::string_view rest = cell.substr(digits);
    const auto sign = std::ranges::find_if(kSigns, [rest](std::string_view one) { return rest.starts_with(one); });
    if (!begins || sign == kSigns.end()) return std::nullopt;
    plain += cell.substr(0, digits);
    std::string_view left = rest;
    GroupedNumber found{sign->size() == 1 ? sign->front() : *sign == "\u2019" ? '\'' : ' ', 0, 0};
    while (left.starts_with(*sign)) {
        const std::string_view group = left.substr(sign->size(), kThousand);
        if (group.size() < kThousand || !std::ranges::all_of(group, is_digit)) return std::nullopt;
        plain += group;
        left.remove_prefix(sign->size() + kThousand);
        ++found.groups;
    }
    if (!left.empty() && is_digit(left.front())) return std::nullopt;
    const bool decimals = !left.empty() && (left.front() == '.' || left.front() == ',');
    if (decimals) plain += '.', left.remove_prefix(1);
    plain += left;
    const bool whole = left.find_first_of(".,") == std::string_view::npos;
    if (!whole || parse_number(plain, found.number) != NumberStatus::kNumber) return std::nullopt;
    return found;
}

NumberAndRest number_and_rest(std::string_view cell) {
    cell = trimmed_cell(cell);
    constexpr std::string_view kDigits = "0123456789";
    if (cell.empty() || std::string_view("0123456789+-.,").find(cell.front()) == std::string_view::npos) return {};
    for (std::size_t end = cell.find_last_of(kDigits); end != std::string_view::npos && end < cell.size();
         end = end == 0 ? std::string_view::npos : cell.find_last_of(kDigits, end - 1)) {
        NumberAndRest found;
        const std::string_view number = cell.substr(0, end + 1);
        found.rest = trimmed_cell(cell.substr(end + 1));
        if (found.rest.empty()) continue;
        if (parse_number(number, found.number) == NumberStatus::kNumber) return found;
        if (const auto grouped = grouped_number(number)) return found.number = grouped->number, found;
    }
    return {};
}

}  // namespace dynlab::inline data_io
