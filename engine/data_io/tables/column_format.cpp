#include "data_io/tables/column_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "data_io/tables/unit_text.h"
#include "platform/error.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

using Kind = ColumnFormat::Kind;

struct SwitchWords {
    std::string_view on, off;
};
constexpr std::array<SwitchWords, 20> kSwitches = {
    {{"on", "off"},          {"true", "false"},        {"high", "low"},         {"yes", "no"},
     {"open", "closed"},     {"open", "close"},        {"enabled", "disabled"}, {"active", "inactive"},
     {"running", "stopped"}, {"run", "stop"},          {"ein", "aus"},          {"an", "aus"},
     {"wahr", "falsch"},     {"ja", "nein"},           {"auf", "zu"},           {"oui", "non"},
     {"vrai", "faux"},       {"marche", "arr\u00EAt"}, {"marche", "arret"},     {"ouvert", "ferm\u00E9"}}};

/// What the cells of a column look like.
struct CellCounts {
    std::size_t numbers = 0, clocks = 0, measures = 0, texts = 0;
    std::size_t decimal_points = 0, decimal_commas = 0;           ///< that cannot be between thousands
    std::size_t grouped = 0, point_groups = 0, comma_groups = 0;  ///< of thousands; the last two without doubt
    std::size_t maybe_points = 0, maybe_commas = 0;               ///< one sign before three digits
    std::map<std::string, std::size_t> units = {};
    std::vector<std::string> words = {};  ///< different texts in small letters; three are enough
    std::string grouped_example = {}, measure_example = {}, clock_example = {};

    void add(std::string_view cell) {
        double number = 0;
        const NumberStatus status = parse_number(cell, number);
        if (status == NumberStatus::kMissing) return;
        if (const auto group = grouped_number(cell)) {
            add_group(cell, *group);
            ++numbers;
        } else if (status != NumberStatus::kNotANumber) {
            decimal_points += cell.find('.') != std::string_view::npos;
            decimal_commas += cell.find(',') != std::string_view::npos;
            ++numbers;
        } else if (clock_cell(cell)) {
            if (clocks++ == 0) clock_example = cell;
        } else if (const NumberAndRest measure = number_and_rest(cell); is_unit(measure.rest)) {
            if (measures++ == 0) measure_example = cell;
            ++units[std::string(measure.rest)];
        } else {
            ++texts;
            const std::string word = in_small_letters(std::string(cell));
            if (words.size() < 3 && std::ranges::find(words, word) == words.end()) words.push_back(word);
        }
    }

  private:
    void add_group(std::string_view cell, const GroupedNumber& group) {
        const bool other = cell.find(group.sign == ',' ? '.' : ',') != std::string_view::npos;
        const bool sure = group.groups > 1 || other;
        if (group.sign == ',') ++(sure ? comma_groups : maybe_commas);
        if (group.sign == '.') ++(sure ? point_groups : maybe_points);
        if (grouped++ == 0) grouped_example = cell;
    }
};

/// The sign between thousands: a point or comma before three digits is one where another number of the column or of
/// the table has the other sign before its decimals, and none has this one there.
char thousands_of(const CellCounts& column, const CellCounts& table) {
    const bool commas = column.comma_groups > 0 && column.decimal_commas == 0;
    const bool points = column.point_groups > 0 && column.decimal_points == 0;
    if (commas != points) return commas ? ',' : '.';
    if (commas) return 0;
    if (column.maybe_commas > 0 && table.decimal_points > 0 && table.decimal_commas == 0) return ',';
    if (column.maybe_points > 0 && table.decimal_commas > 0 && table.decimal_points == 0) return '.';
    return 0;
}

/// The two words of a switch; nothing for others.
std::optional<SwitchWords> switch_of(const std::vector<std::string>& words) {
    const auto fits = [&words](const SwitchWords& pair) {
        return std::ranges::all_of(words, [&](const std::string& word) { return word == pair.on || word == pair.off; });
    };
    const auto found = words.empty() ? kSwitches.end() : std::ranges::find_if(kSwitches, fits);
    return found == kSwitches.end() ? std::nullopt : std::optional(*found);
}

ColumnFormat format_of(const CellCounts& column, const CellCounts& table) {
    ColumnFormat format;
    const std::size_t values = column.numbers + column.clocks + column.measures;
    if (values < column.texts) {
        format.kind = Kind::kText;
        if (const auto words = switch_of(column.words); words && values == 0)
            format.kind = Kind::kSwitch, format.on = words->on, format.off = words->off;
    } else if (column.clocks > column.numbers + column.measures) {
        format.kind = Kind::kClock;
        format.example = column.clock_example;
    } else if (column.measures > column.numbers) {
        format.kind = Kind::kMeasure;
        const auto most_frequent =
            std::ranges::max_element(column.units, {}, [](const auto& unit) { return unit.second; });
        format.unit = most_frequent->first;
        format.example = column.measure_example;
    }
    format.thousands = thousands_of(column, table);
    if (format.kind == Kind::kNumber && column.grouped > column.maybe_commas + column.maybe_points)
        format.example = column.grouped_example;
    if (format.kind == Kind::kNumber && format.thousands != 0) format.example = column.grouped_example;
    return format;
}

NumberStatus read_number_cell(const ColumnFormat& format, std::string_view cell, double& number) {
    const bool plain_sign = format.thousands == 0 || cell.find(format.thousands) == std::string_view::npos;
    const NumberStatus status = plain_sign ? parse_number(cell, number) : NumberStatus::kNotANumber;
    if (status != NumberStatus::kNotANumber) return status;
    const auto grouped = grouped_number(cell);
    const bool of_column =
        grouped && (grouped->sign == format.thousands || grouped->sign == ' ' || grouped->sign == '\'');
    if (!of_column) return NumberStatus::kNotANumber;
    number = grouped->number;
    return NumberStatus::kNumber;
}

NumberStatus read_measure(const ColumnFormat& format, std::string_view cell, double& number) {
    const NumberAndRest measure = number_and_rest(cell);
    if (measure.rest.empty()) return read_number_cell(format, cell, number);
    if (measure.rest != format.unit) return NumberStatus::kNotANumber;
    const std::string_view digits = trimmed_cell(cell.substr(0, cell.rfind(measure.rest)));
    return read_number_cell(format, digits, number);
}

NumberStatus read_switch(const ColumnFormat& format, std::string_view cell, double& number) {
    const std::string word = in_small_letters(std::string(cell));
    if (word == format.on || word == format.off) return number = word == format.on, NumberStatus::kNumber;
    const NumberStatus status = parse_number(cell, number);
    return status == NumberStatus::kMissing ? status : NumberStatus::kNotANumber;
}

NumberStatus read_clock(std::string_view cell, double& number, ClockForms& clocks) {
    const auto clock = clock_cell(cell);
    if (!clock) {
        const NumberStatus status = parse_number(cell, number);
        return status == NumberStatus::kMissing ? status : NumberStatus::kNotANumber;
    }
    number = clock->seconds;
    clocks.two_fields |= clock->form == ClockForm::kTwoFields;
    clocks.day_first |= clock->form == ClockForm::kDayFirst;
    clocks.month_first |= clock->form == ClockForm::kMonthFirst;
    clocks.either_first |= clock->form == ClockForm::kEitherFirst;
    clocks.dated |= clock->form != ClockForm::kTime && clock->form != ClockForm::kTwoFields;
    return NumberStatus::kNumber;
}

std::string shown_cell(std::string_view given) {
    constexpr std::size_t kMaxLength = 40;
    given = trimmed_cell(given);
    return given.size() <= kMaxLength ? fmt::format("\"{}\"", given)
                                      : fmt::format("\"{}...\"", given.substr(0, kMaxLength));
}

}  // namespace

std::vector<ColumnFormat> formats_of(std::span<const std::vector<std::string>* const> rows, std::size_t columns,
                                     char separator) {
    std::vector<CellCounts> counts(columns);
    for (const std::vector<std::string>* row : rows)
        for (std::size_t j = 0; j < std::min(columns, row->size()); ++j) counts[j].add((*row)[j]);
    CellCounts table;
    table.decimal_points = separator == ',';  // who separates by commas has no decimal commas, unless they are seen
    for (const CellCounts& column : counts) {
        table.decimal_points += column.decimal_points;
        table.decimal_commas += column.decimal_commas;
    }
    std::vector<ColumnFormat> formats;
    for (const CellCounts& column : counts) formats.push_back(format_of(column, table));
    return formats;
}

NumberStatus read_cell(const ColumnFormat& format, std::string_view cell, double& number, ClockForms& clocks) {
    number = std::numeric_limits<double>::quiet_NaN();
    switch (format.kind) {
        case Kind::kMeasure:
            return read_measure(format, cell, number);
        case Kind::kSwitch:
            return read_switch(format, cell, number);
        case Kind::kClock:
            return read_clock(cell, number, clocks);
        default:
            return read_number_cell(format, cell, number);
    }
}

bool is_number_in_disguise(std::string_view cell) {
    return grouped_number(cell) || clock_cell(cell) || is_unit(number_and_rest(cell).rest);
}

void refuse_cell(const CellPlace& place, std::string_view cell, const ColumnFormat& format) {
    const std::string file = place.file.string(), given = shown_cell(cell);
    double number = 0;
    const NumberStatus status = parse_number(cell, number);
    if (format.kind == Kind::kSwitch)
        throw EnvironmentError("{}, line {}, column {}: expected {} or {} as in the other rows, got {}", file,
                               place.line, place.column, format.on, format.off, given);
    if (format.kind == Kind::kClock)
        throw EnvironmentError("{}, line {}, column {}: expected a time as in the other rows, such as {}, got {}", file,
                               place.line, place.column, format.example, given);
    if (format.kind == Kind::kMeasure)
        throw EnvironmentError(
            "{}, line {}, column {}: expected a number with the unit {} as in the other rows, got {}", file, place.line,
            place.column, format.unit, given);
    if (status == NumberStatus::kNotFinite)
        throw EnvironmentError(
            "{}, line {}, column {}: expected a finite number, got {}; leave the cell of a missing sample empty, or "
            "write NaN",
            file, place.line, place.column, given);
    if (status == NumberStatus::kOutOfRange)
        throw EnvironmentError("{}, line {}, column {}: expected a number within the range of double precision, got {}",
                               file, place.line, place.column, given);
    if (grouped_number(cell))
        throw EnvironmentError(
            "{}, line {}, column {}: expected a number, got {}; write it without thousands separators", file,
            place.line, place.column, given);
    if (is_unit(number_and_rest(cell).rest))
        throw EnvironmentError(
            "{}, line {}, column {}: expected a number, got {}; write the unit in the header, not in the cell", file,
            place.line, place.column, given);
    throw EnvironmentError(
        "{}, line {}, column {}: expected a number, got {}; leave the cell of a missing sample empty, or write NaN",
        file, place.line, place.column, given);
}

}  // namespace dynlab::inline data_io
