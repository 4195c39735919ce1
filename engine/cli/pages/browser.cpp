#include "cli/pages/browser.h"

#include <cstdlib>

#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"

namespace dynlab::inline cli {

void DesktopBrowser::open(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    if (!find_program("xdg-open")) return;
    try {
        const std::filesystem::path file = folder_.emplace().path() / "open.html";
        write_file_atomically(
            file,
            "<!DOCTYPE html><title>dynlab</title><meta http-equiv=\"refresh\" content=\"0;url=" + address + "\">");
        using std::filesystem::perms;
        std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
        ChildOptions xdg_open;
        xdg_open.command = {"xdg-open", file.string()};
        xdg_open.timeout = std::chrono::seconds(10);
        run_child(xdg_open, "xdg-utils");
    } catch (const std::exception&) {
        return;
    }
}

}  // namespace dynlab::inline cli
