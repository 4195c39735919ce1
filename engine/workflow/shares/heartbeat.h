#pragma once
#include <cstdint>
#include <string>

namespace dynlab::inline workflow {

/// What a worker says of itself again and again: its heartbeat.
struct WorkerStatus {
    std::string node, isolation;
    int hands = 0;           ///< processes that work at once
    std::uint64_t beat = 0;  ///< grows
    std::uint64_t done = 0;  ///< jobs
    std::string trouble;     ///< why it waits ("no space left on device"); empty as long as it works
    std::string refused;     ///< why it must not work here at all
    bool ended = false;
};

/// What the coordinator says, likewise. The counts let one that is started again go on judging fairly.
struct CoordinatorStatus {
    std::uint64_t beat = 0, wanted = 0, done = 0, given_up = 0;
    std::uint64_t lost = 0;    ///< how often a job lost its worker
    std::uint64_t blamed = 0;  ///< of these, by jobs that were given up for it
};

}  // namespace dynlab::inline workflow
