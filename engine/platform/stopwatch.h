#pragma once
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace dynlab::inline platform {

using Timings = std::vector<std::pair<std::string, double>>;  ///< seconds of each step

inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Notes what each step of some work has taken, from its making or from the step before on.
class Stopwatch {
  public:
    explicit Stopwatch(Timings* timings) : timings_(timings) {}  ///< nullptr: notes nothing
    void note(const std::string& step) {
        const auto now = std::chrono::steady_clock::now();
        if (timings_) timings_->emplace_back(step, std::chrono::duration<double>(now - start_).count());
        start_ = now;
    }

  private:
    Timings* timings_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace dynlab::inline platform
