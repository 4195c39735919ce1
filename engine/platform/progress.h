#pragma once
#include <chrono>
#include <string>

namespace dynlab {

/// A bar with count and time left on standard error when that is a terminal, silent otherwise. Appears after
/// 0.3 s.
class ProgressBar {
  public:
    ProgressBar(std::string what, std::size_t total);
    ~ProgressBar();  ///< clears the line
    void advance(std::size_t done);
    void message(const std::string& text);  ///< replaces the description (for steps instead of counts)

  private:
    void show();
    std::string what_;
    std::size_t total_, done_ = 0;
    bool on_terminal_;
    std::chrono::steady_clock::time_point start_, shown_;
};

}  // namespace dynlab
