#include "platform/terminal/terminal_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include "platform/system_call.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline platform {
namespace {

constexpr char kClearLine[] = "\r\033[K";

std::size_t terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80u;
}

/// At most so many characters of an UTF-8 text.
std::string beginning_of(const std::string& text, std::size_t characters) {
    std::size_t end = 0;
    for (; end < text.size(); ++end)
        if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && characters-- == 0) break;
    return text.substr(0, end);
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
