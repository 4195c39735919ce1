#include "platform/terminal/activity_line.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include "platform/terminal/terminal_output.h"

namespace dynlab::inline platform {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstShownAfter = 1s;
constexpr auto kRefreshInterval = 200ms;

std::mutex current_mutex;
ActivityLine* current_line = nullptr;  // guarded by current_mutex

/// While one lives, signals go to other threads than those that begin.
class SignalBlock {
  public:
    SignalBlock() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~SignalBlock() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalBlock(const SignalBlock&) = delete;
    SignalBlock& operator=(const SignalBlock&) = delete;

  private:
    sigset_t before_;
};

}  // namespace

std::string lasting_text(const std::string& what, double seconds) {
    const auto whole = static_cast<long>(seconds);
    if (whole < 60) return fmt::format("{}  {} s", what, whole);
    return fmt::format("{}  {} min {} s", what, whole / 60, whole % 60);
}

ActivityLine::ActivityLine() : on_terminal_(::isatty(STDERR_FILENO) == 1) {
    if (!on_terminal_) return;
    const SignalBlock held;
    refresher_ = std::thread([this] { refresh_now_and_then(); });
    const std::lock_guard lock(current_mutex);
    current_line = this;
}

ActivityLine::~ActivityLine() {
    if (!on_terminal_) return;
    {
        const std::scoped_lock lock(current_mutex, mutex_);
        current_line = nullptr;
        ending_ = true;
        erase();
    }
    over_.notify_all();
    refresher_.join();
}

void ActivityLine::begin_step(const std::string& step) {
    const std::lock_guard lock(mutex_);
    step_ = step;
    part_.clear();
    bar_.clear();
    draw();
}

void ActivityLine::begin_part(const std::string& part) {
    const std::lock_guard lock(mutex_);
    part_ = part;
    part_since_ = Clock::now();
    if (shown_) draw();
}

void ActivityLine::print(const std::string& text, const std::function<void(const std::string&)>& print) {
    const std::lock_guard lock(mutex_);
    erase();
    print(text);
    if (!text.empty()) in_text_ = text.back() != '\n';
}

bool ActivityLine::show_bar(const std::string& bar) {
    const std::lock_guard lock(current_mutex);
    if (current_line == nullptr) return false;
    const std::lock_guard lock_of_line(current_line->mutex_);
    current_line->bar_ = bar;
    current_line->draw();
    return true;
}

void ActivityLine::refresh_now_and_then() {
    std::unique_lock lock(mutex_);
    while (!over_.wait_for(lock, kRefreshInterval, [this] { return ending_; }))
        if (!part_.empty()) draw();
}

/// Not behind a text whose line is not over, which would be erased.
void ActivityLine::draw() {
    if (!on_terminal_ || in_text_) return;
    const auto lasting = Clock::now() - part_since_;
    std::string line = step_.empty() ? step_ : step_ + " ...";
    if (!part_.empty() && lasting >= kFirstShownAfter)
        line = lasting_text(part_, std::chrono::duration<double>(lasting).count());
    if (!bar_.empty()) line += (line.empty() ? "" : "  ") + bar_;
    if (line.empty()) return erase();
    show_terminal_line(line);
    shown_ = true;
}

void ActivityLine::erase() {
    if (shown_) clear_terminal_line();
    shown_ = false;
}

}  // namespace dynlab::inline platform
