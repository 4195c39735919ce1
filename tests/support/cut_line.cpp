#include "support/cut_line.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace dynlab::test {
namespace {

sockaddr_in address_of(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

bool write_whole(int file, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = ::send(file, text.data() + done, text.size() - done, MSG_NOSIGNAL);
        if (count <= 0) return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

}  // namespace

CutLine::CutLine(const std::string& address)
    : name_(address.substr(7, address.find(':', 7) - 7)),
      server_(std::stoi(address.substr(address.find(':', 7) + 1))),
      socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    int low = 10;
    while (low * 10 <= server_) low *= 10;
    for (int tried = low + 1; tried < low * 10 && port_ == 0; ++tried) {
        const sockaddr_in own = address_of(tried);
        if (tried != server_ && ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) == 0)
            port_ = tried;
    }
    constexpr int kWaiting = 16;
    if (port_ == 0 || ::listen(socket_.get(), kWaiting) != 0) throw std::runtime_error("there is no free port");
    listener_ = std::thread([this] { listen(); });
}

CutLine::~CutLine() {
    over_ = true;
    cut();
    listener_.join();
    for (std::thread& worker : workers_) worker.join();
}

std::string CutLine::address(const std::string& of_server) const {
    std::string address = of_server;
    replace_all(address, ":" + std::to_string(server_), ":" + std::to_string(port_));
    return address;
}

void CutLine::cut() {
    cut_ = true;
    const std::lock_guard lock(mutex_);
    for (const Connection& connection : connections_) {
        ::shutdown(connection.from.get(), SHUT_RDWR);
        ::shutdown(connection.to.get(), SHUT_RDWR);
    }
}

void CutLine::listen() {
    constexpr int kLook = 20;  // ms
    while (!over_) {
        pollfd waiting{socket_.get(), POLLIN, 0};
        if (::poll(&waiting, 1, kLook) <= 0) continue;
        FileDescriptor from(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (cut_ || from.get() < 0) continue;
        FileDescriptor to(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        const sockaddr_in address = address_of(server_);
        if (::connect(to.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) continue;
        const std::lock_guard lock(mutex_);
        Connection& connection = connections_.emplace_back(std::move(from), std::move(to));
        workers_.emplace_back([this, &connection] { pass_on(connection); });
    }
}

void CutLine::pass_on(Connection& connection) {
    const std::string here = name_ + ":" + std::to_string(port_), there = name_ + ":" + std::to_string(server_);
    std::array<char, 65536> buffer;
    while (true) {
        pollfd waiting[2] = {{connection.from.get(), POLLIN, 0}, {connection.to.get(), POLLIN, 0}};
        ::poll(waiting, 2, -1);
        for (int side = 0; side < 2; ++side) {
            if (!waiting[side].revents) continue;
            const ssize_t count = ::recv(waiting[side].fd, buffer.data(), buffer.size(), 0);
            std::string text(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
            if (side == 0)
                replace_all(text, here, there);
            else
                bytes_from_server_ += text.size();
            if (count <= 0 || !write_whole(waiting[1 - side].fd, text)) {
                ::shutdown(connection.from.get(), SHUT_RDWR);
                ::shutdown(connection.to.get(), SHUT_RDWR);
                return;
            }
        }
    }
}

}  // namespace dynlab::test
