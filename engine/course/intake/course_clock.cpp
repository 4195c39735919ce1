#include "course/intake/course_clock.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "base/reader.h"
#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

std::string formatted(const std::tm& time, const char* format) {
    char text[64];
    return {text, std::strftime(text, sizeof text, format, &time)};
}

std::tm local(Instant instant) {
    const std::time_t seconds = instant;
    std::tm time{};
    ::localtime_r(&seconds, &time);
    return time;
}

bool same_reading(const std::tm& a, const std::tm& b) {
    return a.tm_year == b.tm_year && a.tm_mon == b.tm_mon && a.tm_mday == b.tm_mday && a.tm_hour == b.tm_hour &&
           a.tm_min == b.tm_min;
}

}  // namespace

CourseClock::CourseClock(const std::string& zone) : zone_(zone) {
    namespace fs = std::filesystem;
    const bool odd = zone.empty() || zone.front() == '/' || zone.find("..") != std::string::npos;
    std::error_code ignored;
    if (odd || (zone != "UTC" && !fs::is_regular_file(fs::path("/usr/share/zoneinfo") / zone, ignored)))
        throw InvalidArgument(
            "unknown time zone \"{}\"; give a name such as Europe/Paris or UTC. For a list of names, install the "
            "package tzdata and run: timedatectl list-timezones",
            zone);
    ::setenv("TZ", zone.c_str(), 1);
    ::tzset();
}

Instant CourseClock::now() {
    return static_cast<Instant>(std::time(nullptr));
}

std::optional<ClockReading> clock_reading(const std::string& text, std::initializer_list<const char*> forms, bool utc) {
    for (const char* form : forms) {
        std::tm time{};
        const char* const end = ::strptime(text.c_str(), form, &time);
        if (end == nullptr || *end != '\0') continue;
        time.tm_isdst = -1;
        std::tm normal = time;
        const Instant instant = utc ? ::timegm(&normal) : std::mktime(&normal);
        return ClockReading{instant, same_reading(normal, time)};
    }
    return {};
}

std::optional<ClockReading> plain_clock_reading(const std::string& text, bool utc) {
    return clock_reading(text, {"%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M", "%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M"}, utc);
}

Instant CourseClock::parse(const std::string& text, const std::string& what) const {
    const bool utc = text.ends_with('Z');
    const auto read = plain_clock_reading(utc ? text.substr(0, text.size() - 1) : text, utc);
    if (!read)
        throw InvalidArgument("{} must be a time such as \"2026-03-01 18:00\" ({}), but \"{}\" was given", what, zone_,
                              text);
    if (!read->exists && utc)
        throw InvalidArgument("{} \"{}\" does not exist in the calendar; correct the date", what, text);
    if (!read->exists)
        throw InvalidArgument(
            "{} \"{}\" does not exist in {}, because the date is not in the calendar or the clocks go forward at that "
            "time. Give another time",
            what, text, zone_);
    constexpr Instant kHour = 3600;
    for (const Instant other : {read->instant - kHour, read->instant + kHour})
        if (!utc && same_reading(local(other), local(read->instant)))
            throw InvalidArgument(
                "{} \"{}\" occurs twice in {}, because the clocks go back. Give the time in UTC: \"{}\" or \"{}\"",
                what, text, zone_, utc_text(std::min(other, read->instant)), utc_text(std::max(other, read->instant)));
    return read->instant;
}

std::string CourseClock::show(Instant instant) const {
    return formatted(local(instant), "%a %Y-%m-%d %H:%M");
}

std::string CourseClock::show_exactly(Instant instant) const {
    return formatted(local(instant), "%Y-%m-%d %H:%M:%S %Z");
}

std::string utc_text(Instant instant) {
    const std::time_t seconds = instant;
    std::tm time{};
    ::gmtime_r(&seconds, &time);
    return formatted(time, "%Y-%m-%dT%H:%M:%SZ");
}

Message duration_message(std::int64_t seconds) {
    const auto d = seconds / 86400, h = seconds / 3600 % 24, min = seconds / 60 % 60, s = seconds % 60;
    if (d > 0) return h > 0 ? Message("{} d {} h", d, h) : Message("{} d", d);
    if (h > 0) return min > 0 ? Message("{} h {} min", h, min) : Message("{} h", h);
    if (min > 0) return s > 0 ? Message("{} min {} s", min, s) : Message("{} min", min);
    return Message("{} s", s);
}

std::string duration_text(std::int64_t seconds) {
    return message_text(duration_message(seconds));
}

std::optional<std::int64_t> duration_of(const std::string& text) {
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || count < 0 || count > 100000) return {};
    std::string unit(end, text.data() + text.size());
    std::erase(unit, ' ');
    if (unit == "s" || (unit.empty() && count == 0)) return count;
    if (unit == "m" || unit == "min") return count * 60;
    if (unit == "h") return count * 3600;
    if (unit == "d") return count * 86400;
    return {};
}

}  // namespace dynlab::inline course
