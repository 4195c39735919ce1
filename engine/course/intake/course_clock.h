#pragma once
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "base/message.h"

namespace dynlab::inline course {

/// Seconds since 1970, UTC.
using Instant = std::int64_t;

/// The course's time zone, such as "Europe/Paris". One zone a process: the system's zone is set to it.
class CourseClock {
  public:
    /// Throws InvalidArgument for a zone this machine does not know.
    explicit CourseClock(const std::string& zone);

    static Instant now();
    const std::string& zone() const { return zone_; }
    /// "2026-03-01 18:00" with optional seconds and optional T, in the zone; with a Z at the end, UTC. Throws
    /// InvalidArgument that names `what` for anything else, days that do not exist among them, and times that the
    /// change to summer time leaves out.
    Instant parse(const std::string& text, const std::string& what) const;
    std::string show(Instant instant) const;          ///< "Sun 2026-03-01 18:00"
    std::string show_exactly(Instant instant) const;  ///< "2026-03-01 18:00:05 CET"

  private:
    std::string zone_;
};

/// What a clock shows, as an instant.
struct ClockReading {
    Instant instant = 0;
    bool exists = true;  ///< false for 30 February, and for what a change to summer time leaves out
};
/// A text in one of these forms (of strptime), read in the process's time zone or as UTC; nothing for any other.
std::optional<ClockReading> clock_reading(const std::string& text, std::initializer_list<const char*> forms,
                                          bool utc = false);
/// The forms "2026-03-01 18:00", with seconds, and with a T.
std::optional<ClockReading> plain_clock_reading(const std::string& text, bool utc = false);

std::string utc_text(Instant instant);  ///< "2026-03-01T17:00:05Z"
/// "3 d 4 h", "2 h 5 min", "40 s": the two largest units.
Message duration_message(std::int64_t seconds);
std::string duration_text(std::int64_t seconds);  ///< in English
/// Seconds in "90 s", "15 min" or "15m", "2 h", "1 d", "0"; nothing for anything else.
std::optional<std::int64_t> duration_of(const std::string& text);

}  // namespace dynlab::inline course
