#include "platform/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "platform/terminal/activity_line.h"
#include "platform/terminal/terminal_output.h"

namespace dynlab::inline platform {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kQuietStart = 300ms;
constexpr auto kBetweenShows = 100ms;
constexpr std::size_t kBarCells = 20;

std::string time_left(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    return whole < 90 ? fmt::format("{} s left", whole) : fmt::format("{} min left", (whole + 59) / 60);
}

ProgressBar::Listener& bar_listener() {
    static ProgressBar::Listener listener;
    return listener;
}

}  // namespace

void ProgressBar::set_listener(Listener listener) {
    bar_listener() = std::move(listener);
}

void write_progress(std::size_t done, std::size_t total) {
    if (const char* const file = std::getenv(kFileOfProgress))
        std::ofstream(file, std::ios::trunc) << done << " " << total << "\n";
}

std::optional<double> progress_in(const std::filesystem::path& file) {
    std::size_t done = 0, total = 0;
    if (!(std::ifstream(file) >> done >> total) || total == 0) return {};
    return static_cast<double>(std::min(done, total)) / static_cast<double>(total);
}

std::string progress_line(const std::string& what, std::size_t done, std::size_t total, double seconds_so_far) {
    std::string line = what;
    if (total > 0) {
        done = std::min(done, total);
        const std::size_t filled = kBarCells * done / total;
        line +=
            fmt::format("  [{}{}]  {}/{}", std::string(filled, '#'), std::string(kBarCells - filled, '-'), done, total);
        if (done > 0) {
            line += "  " + time_left(seconds_so_far * static_cast<double>(total - done) / static_cast<double>(done));
        }
    }
    return line;
}

ProgressBar::ProgressBar(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      on_terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

ProgressBar::~ProgressBar() {
    if (!visible_) return;
    if (bar_listener())
        bar_listener()(0, 0);
    else if (!ActivityLine::show_bar({}))
        clear_terminal_line();
}

void ProgressBar::advance(std::size_t done) {
    done_ = done;
    show_now_and_then();
}

void ProgressBar::message(const std::string& text) {
    what_ = text;
    show_now_and_then();
}

void ProgressBar::show_now_and_then() {
    if (!on_terminal_ && !bar_listener()) return;
    const auto now = Clock::now();
    if (now - start_ < kQuietStart || (visible_ && now - last_shown_ < kBetweenShows)) return;
    last_shown_ = now;
    visible_ = true;
    if (bar_listener()) return bar_listener()(done_, total_);
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const std::string bar = progress_line(what_, done_, total_, seconds);
    if (!ActivityLine::show_bar(bar)) show_terminal_line(bar);
}

}  // namespace dynlab::inline platform
