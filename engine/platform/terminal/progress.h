#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace dynlab::inline platform {

/// "what  [#####-----]  50/100  3 s left"; with total 0 only "what".
std::string progress_line(const std::string& what, std::size_t done, std::size_t total, double seconds_so_far);

/// Names, in the environment of a command, the file in which another process reads how far it is.
inline constexpr const char* kFileOfProgress = "DYNLAB_PROGRESS";
void write_progress(std::size_t done, std::size_t total);  ///< into that file, where there is one
/// What such a file says, from 0 to 1; nothing where it says nothing yet.
std::optional<double> progress_in(const std::filesystem::path& file);

/// A bar with count and time left on standard error when that is a terminal, behind what an ActivityLine shows there;
/// silent otherwise. Appears after 0.3 s.
class ProgressBar {
  public:
    /// Sends the progress of all bars to `listener` instead of drawing it, as often as a bar would be drawn. At the end
    /// of a bar the listener gets 0 of 0. The thread that advances a bar calls the listener.
    using Listener = std::function<void(std::size_t done, std::size_t total)>;
    static void set_listener(Listener listener);

    ProgressBar(std::string what, std::size_t total);
    ~ProgressBar();  ///< clears the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    void advance(std::size_t done);         ///< `done` of the total are done now
    void message(const std::string& text);  ///< replaces the description (for steps instead of counts)

  private:
    void show_now_and_then();
    std::string what_;
    std::size_t total_, done_ = 0;
    bool on_terminal_;
    std::chrono::steady_clock::time_point start_, last_shown_;
    bool visible_ = false;
};

}  // namespace dynlab::inline platform
