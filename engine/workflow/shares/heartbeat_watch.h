#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

namespace dynlab::inline workflow {

/// How long somebody else has shown no sign of life, by the observer's own clock alone: what counts is that the number
/// changes, not what time anybody thinks it is.
class HeartbeatWatch {
  public:
    using Clock = std::chrono::steady_clock;
    void see(std::uint64_t beat, Clock::time_point now = Clock::now()) {
        if (beat == beat_) return;
        beats_ = beat_.has_value();
        beat_ = beat;
        changed_ = now;
    }
    /// Since the last change, or since this object was made.
    Clock::duration lasting(Clock::time_point now = Clock::now()) const { return now - changed_; }

    bool heard() const { return beats_; }  ///< it changed at least once while it was watched

  private:
    std::optional<std::uint64_t> beat_;
    bool beats_ = false;
    Clock::time_point changed_ = Clock::now();
};

}  // namespace dynlab::inline workflow
