#include "platform/terminal/terminal_output.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "platform/system_call.h"
#include "platform/terminal/terminal_text.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

constexpr char kClearLine[] = "\r\033[K";

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
    print(kClearLine + beginning_of(terminal_text(text), terminal_columns(STDERR_FILENO, 80) - 1));
}

void clear_terminal_line() {
    print(kClearLine);
}

void print_now(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
}

void print_shown(const std::string& text) {
    static const bool terminal = ::isatty(STDOUT_FILENO) == 1;
    print_now(terminal ? terminal_text(text) : text);
}

std::size_t terminal_columns(int descriptor, std::size_t otherwise) {
    winsize size{};
    return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : otherwise;
}

std::size_t columns_of_text(std::size_t otherwise) {
    constexpr std::size_t kMaxWidth = 100;  // longer lines are hard to read
    return std::min(terminal_columns(STDOUT_FILENO, otherwise), kMaxWidth);
}

bool in_color() {
    const char* no_color = std::getenv("NO_COLOR");
    return ::isatty(STDOUT_FILENO) != 0 && (no_color == nullptr || *no_color == '\0');
}

}  // namespace dynlab::inline platform
