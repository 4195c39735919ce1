#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace dynlab::inline platform {

/// "cell 4 of 12, Validation  2 min 5 s": what has been running, and for how long.
std::string lasting_text(const std::string& what, double seconds);

/// The last line of a terminal while a long piece of work goes on: its step at once, or the part of a step that has
/// lasted a second, with the time it has taken; behind it the bar of a ProgressBar. On standard error when that is a
/// terminal, silent otherwise. One at a time.
class ActivityLine {
  public:
    ActivityLine();
    ~ActivityLine();  ///< clears the line
    ActivityLine(const ActivityLine&) = delete;
    ActivityLine& operator=(const ActivityLine&) = delete;

    void begin_step(const std::string& step);
    void begin_part(const std::string& part);  ///< of the step; the one before it is over
    /// Hands `text` to `print`, which may write it to the same terminal, while the line is out of the way.
    void print(const std::string& text, const std::function<void(const std::string&)>& print);

    /// Where there is a line now, it takes the text of a bar (empty when the bar is over); false where there is none.
    static bool show_bar(const std::string& bar);

  private:
    using Clock = std::chrono::steady_clock;
    void refresh_now_and_then();
    void draw();
    void erase();

    std::mutex mutex_;
    std::condition_variable over_;
    std::string step_, part_, bar_;
    Clock::time_point part_since_;
    bool shown_ = false, in_text_ = false, ending_ = false;
    const bool on_terminal_;
    std::thread refresher_;  ///< runs on a terminal only
};

}  // namespace dynlab::inline platform
