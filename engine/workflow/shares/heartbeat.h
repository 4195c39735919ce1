#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/message.h"

namespace dynlab::inline workflow {

/// What a worker says of itself again and again: its heartbeat.
struct WorkerStatus {
    std::string node, isolation;
    int hands = 0;           ///< processes that work at once
    std::uint64_t beat = 0;  ///< grows
    std::uint64_t done = 0;  ///< jobs
    Message trouble;         ///< why it waits ("no space left on device"); empty as long as it works
    Message refused;         ///< why it must not work here at all
    bool ended = false;
};

/// What the coordinator says, likewise. The counts let one that is started again go on judging fairly.
struct CoordinatorStatus {
    std::uint64_t beat = 0, wanted = 0, done = 0, given_up = 0;
    std::uint64_t lost = 0;    ///< how often a job lost its worker
    std::uint64_t blamed = 0;  ///< of these, by jobs that were given up for it
};

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
