#include "cli/pages/browser.h"

#include <cstdlib>

#include "platform/child_process.h"
#include "platform/program_lookup.h"

namespace dynlab::inline cli {

void open_browser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    if (!find_program("xdg-open")) return;
    ChildOptions xdg_open;
    xdg_open.command = {"xdg-open", address};
    xdg_open.timeout = std::chrono::seconds(10);
    try {
        run_child(xdg_open, "xdg-utils");
    } catch (const std::exception&) {
        return;
    }
}

}  // namespace dynlab::inline cli
