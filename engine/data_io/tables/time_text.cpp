#include "data_io/tables/time_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "data_io/tables/number_cell.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

struct TimeUnit {
    double seconds;
    std::string_view names;  ///< with blanks between them and at both ends
    std::string_view words;  ///< names in headers only, in small letters; those of them that mean nothing but a time
};
constexpr std::array<TimeUnit, 7> kTimeUnits = {
    {{1, " s sec secs second seconds ", " seconde secondes sekunde sekunden segundo segundos "},
     {1e-3, " ms msec millisecond milliseconds ", " msecs millis milli milliseconde millisecondes millisekunden "},
     {1e-6, " us \u00B5s \u03BCs usec microsecond microseconds ", " usecs micros microseconde microsecondes "},
     {1e-9, " ns nsec nanosecond nanoseconds ", " nanos "},
     {60, " min mins minute minutes ", " mn minuten minuto minutos "},
     {3600, " h hr hrs hour hours ", " heure heures stunde stunden hora horas "},
     {86400, " day days ", " d jour jours tag tage "}}};

/// Words for a time, in small letters; words that only go with them.
constexpr std::string_view kTimeWords =
    " t time times temps zeit zeitpunkt uhrzeit heure tiempo tempo tijd timestamp zeitstempel horodatage datetime date "
    "datum clock elapsed epoch unixtime instant instants ";
constexpr std::string_view kSideWords = " in since start stamp relative rel abs absolute sampling sample value unix x ";

bool is_listed(std::string_view list, std::string_view word) {
    return !word.empty() && list.find(" " + std::string(word) + " ") != std::string_view::npos;
}

std::optional<double> seconds_of_word(std::string_view word, bool in_header) {
    for (const TimeUnit& unit : kTimeUnits)
        if (is_listed(unit.names, word) || (in_header && is_listed(unit.words, word))) return unit.seconds;
    return std::nullopt;
}

/// A name's words: "elapsed_time_ms", "Time, ms", "t/ms", "TimeUS".
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words(1);
    const auto kind = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x80 || std::islower(byte) ? 'a' : std::isupper(byte) ? 'A' : std::isdigit(byte) ? '1' : ' ';
    };
    char before = ' ';
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char now = kind(name[i]);
        const bool begins = (before == 'a' && now == 'A') || (before == '1') != (now == '1');
        if ((now == ' ' || begins) && !words.back().empty()) words.emplace_back();
        if (now != ' ') words.back() += name[i];
        before = now;
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

}  // namespace

std::optional<double> seconds_of(std::string_view unit, bool any_case) {
    unit = trimmed_cell(unit);
    if (const auto seconds = seconds_of_word(unit, any_case); seconds || !any_case) return seconds;
    while (!unit.empty() && unit.back() == '.') unit.remove_suffix(1);
    if (const auto seconds = seconds_of_word(in_small_letters(std::string(unit)), true)) return seconds;
    const std::size_t end = unit.find_last_of("0123456789");  // of the number of units
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view count = unit.substr(0, end + 1);
    for (const std::string_view times : {"x", "X", "*", "\u00D7"})
        if (count.starts_with(times)) count = trimmed_cell(count.substr(times.size()));
    const auto one = seconds_of(unit.substr(end + 1), true);
    const std::size_t slash = count.find('/');
    double number = 0, divisor = 1;
    if (!one || parse_number(count.substr(0, slash), number) != NumberStatus::kNumber ||
        (slash != std::string_view::npos && parse_number(count.substr(slash + 1), divisor) != NumberStatus::kNumber) ||
        !(number > 0 && divisor > 0))
        return std::nullopt;
    return number / divisor * *one;
}

TimeName time_name_of(std::string_view name) {
    TimeName found;
    if (name == "T") return found;  // more often a temperature
    const std::vector<std::string> words = words_of(name);
    bool only_units = true, long_unit = false;
    for (const std::string& word : words) {
        const std::string small = in_small_letters(word);
        if (is_listed(kTimeWords, small)) {
            found.is_time = true, only_units = false;
        } else if (seconds_of(word, true) && !found.unit) {
            found.unit = word;
            long_unit = small.size() > 2 && small != "min" && small != "day";
            long_unit = long_unit || is_listed(" ms us ns \u00B5s \u03BCs ", small);
        } else if (is_listed(kSideWords, small)) {
            only_units = only_units && small != "x" && small != "value";
        } else {
            return {};
        }
    }
    // A unit alone, as a microcontroller's millis, is a time where it means nothing else: min is also a minimum.
    const bool in_unit = words.size() > 1 && in_small_letters(words.front()) == "in";
    if (!found.is_time) found.is_time = found.unit && only_units && (long_unit || in_unit);
    return found.is_time ? found : TimeName();
}

}  // namespace dynlab::inline data_io
