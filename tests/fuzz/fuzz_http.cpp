// Requests that any user of the machine can send to the server of pages: their heads, and who gets access.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "app/server/entrance.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dynlab;
    constexpr std::size_t kInBuffer = 100'000;  // what a pair of sockets takes without a reader
    static Entrance entrance(4711);
    static const std::string fields = "A: b\r\n";
    int pair[2], ending[2];
    fuzz::demand(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) == 0 && ::pipe(ending) == 0);
    const FileDescriptor browser(pair[0]), quiet(ending[0]), end(ending[1]);
    HttpConnection connection(FileDescriptor(pair[1]), quiet.get(), fields);
    write_all(browser.get(), reinterpret_cast<const char*>(data), std::min(size, kInBuffer));
    ::shutdown(browser.get(), SHUT_WR);
    try {
        while (auto head = connection.next_head()) {
            fuzz::demand(head->fields.size() <= 100 && head->path.find('\0') == std::string::npos);
            const std::optional<std::size_t> body = head->body;
            try {
                entrance.admit(*head);
                fuzz::demand(false);  // without the cookie
            } catch (const LastReply&) {
                if (!body || !connection.body(*body)) break;
            }
        }
    } catch (const LastReply& last) {
        fuzz::demand(last.reply.status >= 400);
    }
    return 0;
}
