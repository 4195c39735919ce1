#include "platform/terminal/terminal_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include "platform/system_call.h"
#include "platform/terminal/terminal_text.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

constexpr char kClearLine[] = "\r\033[K";

std::size_t terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80u;
}

/// The beginning of a text that fits into `columns` columns.
std::string beginning_of(const std::string& text, std::size_t columns) {
    std::string_view rest = text;
    for (std::size_t used = 0; !rest.empty();) {
        std::string_view behind = rest;
        used += columns_of(next_character(behind));
        if (used > columns) break;
        rest = behind;
    }
    return text.substr(0, text.size() - rest.size());
}

void print(const std::string& text) {
    write_all(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

void show_terminal_line(const std::string& text) {
    print(kClearLine + beginning_of(terminal_text(text), terminal_width() - 1));
}

void clear_terminal_line() {
    print(kClearLine);
}

}  // namespace dynlab::inline platform
