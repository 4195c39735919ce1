#include "app/server/page_connections.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <optional>
#include <system_error>

#include "platform/error.h"

namespace dynlab::inline app {
namespace {

constexpr int kWaiting = 64;  // connections that the system keeps until they are taken
constexpr int kTries = 20;    // of ports that the system gives

/// Browsers also try ::1 for a name of this machine. This socket occupies the port there and does not listen, so that
/// no other user's server receives requests meant for this one. Empty if the port is taken; without IPv6 no one can
/// listen there.
std::optional<FileDescriptor> guard_of(int port) {
    FileDescriptor guard(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in6 address{};
    address.sin6_family = AF_INET6;
    address.sin6_addr = in6addr_loopback;
    address.sin6_port = htons(static_cast<std::uint16_t>(port));
    if (guard && ::bind(guard.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
        (errno == EADDRINUSE || errno == EACCES))
        return {};
    return guard;
}

}  // namespace

PageConnections::PageConnections(int port) : ending_(::eventfd(0, EFD_CLOEXEC)) {
    std::signal(SIGPIPE, SIG_IGN);  // who reads a page or the program's output may be gone, which ends nothing
    bool taken = false;
    for (int tries = port == 0 ? kTries : 1; tries > 0 && !taken; --tries) taken = take(port);
    if (!taken || !ending_)
        throw EnvironmentError("port {} is in use or not permitted; omit --port to use a free port", port);
}

bool PageConnections::take(int port) {
    listening_ = FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const int yes = 1;
    // Not SO_REUSEPORT, which would share a port that is taken.
    ::setsockopt(listening_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    socklen_t size = sizeof address;
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listening_.get(), plain, size) != 0 || ::listen(listening_.get(), kWaiting) != 0 ||
        ::getsockname(listening_.get(), plain, &size) != 0)
        return false;
    port_ = ntohs(address.sin_port);
    std::optional<FileDescriptor> guard = guard_of(port_);
    if (guard) guard_ = std::move(*guard);
    return guard.has_value();
}

PageConnections::~PageConnections() {
    end();
}

void PageConnections::start(Serve serve, Limits limits, std::string fields) {
    serve_ = std::move(serve);
    limits_ = limits;
    fields_ = std::move(fields);
    accepting_ = std::thread([this] { accept_all(); });
}

void PageConnections::end() {
    const std::uint64_t one = 1;
    write_all(ending_.get(), reinterpret_cast<const char*>(&one), sizeof one);
    if (accepting_.joinable()) accepting_.join();
    std::unique_lock lock(mutex_);
    closed_.wait(lock, [this] { return open_.empty(); });
}

void PageConnections::accept_all() {
    pollfd waiting[2] = {{listening_.get(), POLLIN, 0}, {ending_.get(), POLLIN, 0}};
    for (;;) {
        retry_interrupted([&] { return ::poll(waiting, 2, -1); });
        if (waiting[1].revents != 0) return;
        FileDescriptor socket(::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (socket) {
            begin(std::move(socket));
        } else if (errno == EMFILE || errno == ENFILE || errno == ENOMEM) {  // until one of them is closed
            std::unique_lock lock(mutex_);
            closed_.wait_for(lock, std::chrono::milliseconds(100));
        }
    }
}

void PageConnections::begin(FileDescriptor socket) {
    const int yes = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const std::lock_guard lock(mutex_);
    const auto is_unknown = [](const Open& open) { return !open.known && !open.dropped; };
    if (std::count_if(open_.begin(), open_.end(), is_unknown) >= limits_.unknown) {
        const auto oldest = std::find_if(open_.begin(), open_.end(), is_unknown);
        oldest->dropped = true;
        ::shutdown(oldest->socket, SHUT_RDWR);  // its thread reads the end
    }
    if (std::ssize(open_) >= limits_.known + 2 * limits_.unknown) return;
    const auto mine = open_.insert(open_.end(), Open{socket.get()});
    auto owned = std::make_shared<HttpConnection>(std::move(socket), ending_.get(), fields_);
    try {
        std::thread([this, mine, owned = std::move(owned)]() mutable {
            serve_(*owned, [this, mine] {
                const std::lock_guard known_lock(mutex_);
                mine->known = true;
            });
            const std::lock_guard closing_lock(mutex_);
            owned.reset();
            open_.erase(mine);
            closed_.notify_all();
        }).detach();
    } catch (const std::system_error&) {  // no more threads: the connection is closed
        open_.erase(mine);
    }
}

}  // namespace dynlab::inline app
