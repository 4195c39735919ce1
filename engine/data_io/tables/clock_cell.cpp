#include "data_io/tables/clock_cell.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "data_io/tables/number_cell.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline data_io {
namespace {

using Days = std::chrono::sys_days;
constexpr double kMinute = 60, kHour = 3600, kDay = 86400;

double seconds_of_day(Days day) {
    return static_cast<double>(day.time_since_epoch().count()) * kDay;
}

std::optional<double> seconds_of_date(int year, int month, int day) {
    constexpr int kTwoDigits = 100, kPivot = 70;
    if (year < kTwoDigits) year += year < kPivot ? 2000 : 1900;
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return std::nullopt;
    return seconds_of_day(Days(date));
}

/// Takes a text apart from its beginning.
class ClockText {
  public:
    explicit ClockText(std::string_view text) : text_(text) {}

    bool empty() const { return text_.empty(); }
    std::size_t digits() const {
        const std::size_t end = text_.find_first_not_of("0123456789");
        return end == std::string_view::npos ? text_.size() : end;
    }
    bool takes(std::string_view sign) {
        if (!text_.starts_with(sign)) return false;
        text_.remove_prefix(sign.size());
        return true;
    }
    char next() const { return text_.empty() ? '\0' : text_.front(); }
    void skip(std::size_t count = 1) { text_.remove_prefix(count); }
    void skip_blanks() {
        while (next() == ' ') skip();
    }
    /// Of `max_digits` digits or fewer; -1 when there are none, or more.
    int number(std::size_t max_digits) {
        const std::size_t count = std::min(digits(), max_digits);
        if (count == 0 || digits() > max_digits) return -1;
        return fixed(count);
    }
    int fixed(std::size_t count) {
        int value = 0;
        for (std::size_t i = 0; i < count; ++i) value = 10 * value + (text_[i] - '0');
        skip(count);
        return value;
    }
    /// Behind the seconds' decimal sign.
    double fraction() {
        double value = 0, weight = 0.1;
        for (; next() >= '0' && next() <= '9'; skip(), weight /= 10) value += weight * (next() - '0');
        return value;
    }
    std::string word() {
        std::string letters;
        for (; std::isalpha(static_cast<unsigned char>(next())) != 0; skip()) letters += next();
        return in_small_letters(letters);
    }

  private:
    std::string_view text_;
};

/// 1 to 12; 0 for no month. The first three letters identify English, French and German months, except June and July in
/// French.
int month_of(const std::string& word) {
    constexpr std::string_view kMonths =
        "jan1 feb2 fev2 mar3 apr4 avr4 may5 mai5 jun6 jul7 aug8 sep9 oct10 okt10 nov11 dec12 dez12 ";
    constexpr std::size_t kLetters = 3;
    if (word.size() < kLetters) return 0;
    const std::size_t at = kMonths.find(word.substr(0, kLetters));
    if (at == std::string_view::npos || kMonths[at + kLetters] > '9') return 0;
    return std::atoi(kMonths.data() + at + kLetters);
}

struct TimeOfDay {
    double seconds;
    bool two_fields;
};

/// 14:02:33.118, 2:02 PM, 140233 behind a T.
std::optional<TimeOfDay> take_time(ClockText& text, bool compact) {
    constexpr int kSixty = 60;
    constexpr std::size_t kCompact = 6;
    if (compact && text.digits() == kCompact) {
        const int hours = text.fixed(2), minutes = text.fixed(2), seconds = text.fixed(2);
        if (hours > 24 || minutes >= kSixty || seconds > kSixty) return std::nullopt;
        const double part = text.takes(".") || text.takes(",") ? text.fraction() : 0;
        return TimeOfDay{kHour * hours + kMinute * minutes + seconds + part, false};
    }
    int hours = text.number(4);
    if (hours < 0 || !text.takes(":")) return std::nullopt;
    const int minutes = text.number(2);
    if (minutes < 0 || minutes >= kSixty) return std::nullopt;
    TimeOfDay time{kHour * hours + kMinute * minutes, true};
    if (text.takes(":")) {
        const int seconds = text.number(2);
        if (seconds < 0 || seconds > kSixty) return std::nullopt;
        time = {time.seconds + seconds, false};
        if (text.takes(".") || text.takes(",") || text.takes(":")) time.seconds += text.fraction();
    } else if (text.takes(".") || text.takes(",")) {  // 02:33.118
        time = {(time.seconds + text.fraction() * kMinute) / kMinute, false};
    }
    text.skip_blanks();
    constexpr int kNoon = 12;
    ClockText behind = text;
    const std::string half = behind.word();
    if (half != "am" && half != "pm" && half != "a" && half != "p") return time;
    text = behind;
    for (const char* sign : {".m.", "."}) text.takes(sign);
    if (hours > kNoon || hours == 0) return std::nullopt;
    time.seconds += half.front() == 'p' ? (hours == kNoon ? 0 : kNoon * kHour) : hours == kNoon ? -kNoon * kHour : 0;
    return TimeOfDay{time.seconds, false};
}

/// Seconds that a zone is ahead of UTC; nothing for a text that is none.
std::optional<double> take_zone(ClockText& text) {
    text.skip_blanks();
    if (text.empty()) return 0;
    if (text.takes("Z") || text.takes("z") || text.takes("UTC") || text.takes("GMT"))
        if (text.empty()) return 0;
    const double sign = text.takes("+") ? 1 : text.takes("-") ? -1 : 0;
    if (sign == 0 || text.digits() < 2) return std::nullopt;
    double zone = kHour * text.fixed(2);
    text.takes(":");
    if (text.digits() == 2) zone += kMinute * text.fixed(2);
    return text.empty() ? std::optional(sign * zone) : std::nullopt;
}

struct Day {
    double seconds;
    ClockForm form;
};

std::optional<Day> named_month(ClockText& text, int day, int month) {  // 11-Mar-2025
    if (month == 0) return std::nullopt;
    text.takes(".");
    if (text.next() != '-' && text.next() != ' ' && text.next() != '/') return std::nullopt;
    text.skip();
    const int year = text.number(4);
    const auto seconds = day < 1 || year < 0 ? std::nullopt : seconds_of_date(year, month, day);
    return seconds ? std::optional(Day{*seconds, ClockForm::kDate}) : std::nullopt;
}

std::optional<Day> take_day(ClockText& text) {
    constexpr std::size_t kCompact = 8, kYear = 4;
    constexpr int kMonths = 12;
    const auto of = [](const std::optional<double>& seconds, ClockForm form) {
        return seconds ? std::optional(Day{*seconds, form}) : std::nullopt;
    };
    if (text.digits() == kCompact) {  // 20250311, with a time behind it
        const int year = text.fixed(kYear), month = text.fixed(2), day = text.fixed(2);
        return text.next() == 'T' ? of(seconds_of_date(year, month, day), ClockForm::kDate) : std::nullopt;
    }
    const bool year_first = text.digits() == kYear;
    const int first = text.number(kYear);
    const char sign = text.next();
    if (first < 0 || (sign != '-' && sign != '/' && sign != '.' && sign != ' ')) return std::nullopt;
    text.skip();
    if (std::isalpha(static_cast<unsigned char>(text.next())) != 0)
        return named_month(text, first, month_of(text.word()));
    const int second = text.number(2);
    if (second < 0 || text.next() != sign || sign == ' ') return std::nullopt;
    text.skip();
    const int third = text.number(year_first ? 2 : kYear);
    if (third < 0) return std::nullopt;
    if (year_first) return of(seconds_of_date(first, second, third), ClockForm::kDate);
    if (sign == '.') return of(seconds_of_date(third, second, first), ClockForm::kDate);
    if (first > kMonths) return of(seconds_of_date(third, second, first), ClockForm::kDayFirst);
    if (second > kMonths) return of(seconds_of_date(third, first, second), ClockForm::kMonthFirst);
    return of(seconds_of_date(third, second, first), ClockForm::kEitherFirst);
}

}  // namespace

std::optional<ClockCell> clock_cell(std::string_view cell) {
    cell = trimmed_cell(cell);
    if (cell.size() < 4 || cell.size() > 40 || cell.front() < '0' || cell.front() > '9') return std::nullopt;
    ClockText whole(cell);
    if (const auto time = take_time(whole, false)) {
        if (!whole.empty()) return std::nullopt;
        return ClockCell{time->two_fields ? ClockForm::kTwoFields : ClockForm::kTime, time->seconds};
    }
    ClockText text(cell);
    const auto day = take_day(text);
    if (!day) return std::nullopt;
    if (text.empty()) return ClockCell{day->form, day->seconds, true};
    if (!text.takes("T") && !text.takes(" ") && !text.takes(",") && !text.takes("_")) return std::nullopt;
    text.skip_blanks();
    const auto time = take_time(text, true);
    if (!time) return std::nullopt;
    const auto zone = take_zone(text);
    if (!zone) return std::nullopt;
    return ClockCell{day->form, day->seconds + time->seconds - *zone};
}

double with_day_as_month(double seconds) {
    const double midnight = std::floor(seconds / kDay) * kDay;
    const std::chrono::year_month_day date{
        Days(std::chrono::days(static_cast<std::int64_t>(std::llround(midnight / kDay))))};
    const auto swapped =
        seconds_of_date(static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.day())),
                        static_cast<int>(static_cast<unsigned>(date.month())));
    return swapped ? *swapped + (seconds - midnight) : std::nan("");
}

std::string date_text(double seconds) {
    const double midnight = std::floor(seconds / kDay) * kDay;
    const std::chrono::year_month_day date{
        Days(std::chrono::days(static_cast<std::int64_t>(std::llround(midnight / kDay))))};
    const auto second = static_cast<int>(seconds - midnight);
    return fmt::format("{}-{:02}-{:02} {:02}:{:02}:{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), second / 3600,
                       second / 60 % 60, second % 60);
}

}  // namespace dynlab::inline data_io
