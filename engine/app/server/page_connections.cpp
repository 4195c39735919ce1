#include "app/server/page_connections.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>

#include "platform/error.h"

namespace dynlab::inline app {
namespace {

using namespace std::chrono_literals;

/// How long a connection without a request is kept.
constexpr std::chrono::milliseconds kIdleConnection = 10s;
/// Fewer new connections are fewer whose first request comes too late; a page alone asks for twenty files.
constexpr std::size_t kRequestsOfConnection = 1000;

/// Whether a socket is ready; also when it is broken, which the call behind this tells.
bool is_ready(socket_t socket, short wanted, std::chrono::milliseconds longest) {
    pollfd waiting{socket, wanted, 0};
    return retry_interrupted([&] { return ::poll(&waiting, 1, static_cast<int>(longest.count())); }) > 0;
}

/// What httplib reads from and writes to; it reads the head of a request byte by byte.
class SocketStream : public httplib::Stream {
  public:
    SocketStream(socket_t socket, std::chrono::milliseconds longest) : socket_(socket), longest_(longest) {}

    bool has_unread() const { return begin_ < end_; }
    bool is_readable() const override { return has_unread() || is_ready(socket_, POLLIN, longest_); }
    bool is_writable() const override { return is_ready(socket_, POLLOUT, longest_) && !is_gone(); }

    ssize_t read(char* bytes, std::size_t count) override {
        if (!has_unread()) {
            if (!is_readable()) return -1;
            const ssize_t got = retry_interrupted([&] { return ::recv(socket_, read_.data(), read_.size(), 0); });
            if (got <= 0) return got;
            begin_ = 0;
            end_ = static_cast<std::size_t>(got);
        }
        const std::size_t given = std::min(count, end_ - begin_);
        std::copy_n(read_.data() + begin_, given, bytes);
        begin_ += given;
        return static_cast<ssize_t>(given);
    }

    ssize_t write(const char* bytes, std::size_t count) override {
        if (!is_writable()) return -1;
        return retry_interrupted([&] { return ::send(socket_, bytes, count, MSG_NOSIGNAL); });
    }

    // Who asks is known by the cookie: there is one machine.
    void get_remote_ip_and_port(std::string&, int&) const override {}
    void get_local_ip_and_port(std::string&, int&) const override {}
    socket_t socket() const override { return socket_; }

  private:
    bool is_gone() const {
        char next = 0;
        const ssize_t got = ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
        return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
    }

    const socket_t socket_;
    const std::chrono::milliseconds longest_;
    std::array<char, std::size_t{1} << 14> read_{};
    std::size_t begin_ = 0, end_ = 0;
};

}  // namespace

PageConnections::PageConnections() : ending_(::eventfd(0, EFD_CLOEXEC)) {
    if (!ending_) throw EnvironmentError("cannot serve pages: " + system_reason(errno));
    set_keep_alive_timeout(std::chrono::duration_cast<std::chrono::seconds>(kIdleConnection).count());
    set_keep_alive_max_count(kRequestsOfConnection);
}

void PageConnections::end() {
    const std::uint64_t one = 1;
    write_all(ending_.get(), reinterpret_cast<const char*>(&one), sizeof one);
    stop();
}

/// Whether a request comes in time, and before the end.
bool PageConnections::asks(socket_t socket) const {
    pollfd waiting[2] = {{socket, POLLIN, 0}, {ending_.get(), POLLIN, 0}};
    retry_interrupted([&] { return ::poll(waiting, 2, static_cast<int>(kIdleConnection.count())); });
    return waiting[0].revents != 0 && waiting[1].revents == 0;
}

bool PageConnections::process_and_close_socket(socket_t socket) {
    const FileDescriptor closed_at_end(socket);
    SocketStream stream(socket, std::chrono::seconds(read_timeout_sec_));
    for (std::size_t left = keep_alive_max_count_; left > 0 && (stream.has_unread() || asks(socket)); --left) {
        bool over = false;
        if (!process_request(stream, left == 1, over, nullptr) || over) break;
    }
    ::shutdown(socket, SHUT_RDWR);
    return true;
}

}  // namespace dynlab::inline app
