#include "cli/terminal_width.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "scripting/runtime/help.h"

namespace dynlab::inline cli {

std::size_t terminal_width() {
    constexpr std::size_t kWidest = 100;  // longer lines are hard to read
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kHelpWidth;
    return std::min<std::size_t>(size.ws_col, kWidest);
}

}  // namespace dynlab::inline cli
