#include "app/live/channel.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>

#include "platform/error.h"

namespace dynlab::inline app {
namespace {

bool send_all(int socket, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t sent = retry_interrupted([&] { return ::send(socket, bytes, count, MSG_NOSIGNAL); });
        if (sent <= 0) return false;
        bytes += sent;
        count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t got = retry_interrupted([&] { return ::recv(socket, bytes, count, MSG_WAITALL); });
        if (got <= 0) return false;
        bytes += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

/// The message's length, and the file beside it (SCM_RIGHTS).
struct Head {
    std::uint64_t length = 0;
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    iovec part{&length, sizeof length};
    msghdr message{};

    Head() {
        message.msg_iov = &part;
        message.msg_iovlen = 1;
    }
    void attach_control_buffer() {
        message.msg_control = control;
        message.msg_controllen = sizeof control;
    }
};

}  // namespace

std::pair<Channel, Channel> Channel::pair() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw EnvironmentError("cannot open a connection to another process: {}", system_reason(errno));
    return {Channel(FileDescriptor(ends[0])), Channel(FileDescriptor(ends[1]))};
}

bool Channel::send(const std::string& bytes, int file) {
    Head head;
    head.length = bytes.size();
    if (file >= 0) {
        head.attach_control_buffer();
        cmsghdr* const rights = CMSG_FIRSTHDR(&head.message);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(sizeof file);
        std::memcpy(CMSG_DATA(rights), &file, sizeof file);
    }
    const ssize_t sent = retry_interrupted([&] { return ::sendmsg(end_.get(), &head.message, MSG_NOSIGNAL); });
    return sent == sizeof head.length && send_all(end_.get(), bytes.data(), bytes.size());
}

std::optional<Channel::Message> Channel::receive() {
    Head head;
    head.attach_control_buffer();
    const ssize_t got =
        retry_interrupted([&] { return ::recvmsg(end_.get(), &head.message, MSG_CMSG_CLOEXEC | MSG_WAITALL); });
    if (got != sizeof head.length) return {};
    Message message;
    if (const cmsghdr* const rights = CMSG_FIRSTHDR(&head.message); rights && rights->cmsg_type == SCM_RIGHTS) {
        int file = -1;
        std::memcpy(&file, CMSG_DATA(rights), sizeof file);
        message.file = FileDescriptor(file);
    }
    message.bytes.resize(head.length);
    if (!receive_all(end_.get(), message.bytes.data(), message.bytes.size())) return {};
    return message;
}

}  // namespace dynlab::inline app
