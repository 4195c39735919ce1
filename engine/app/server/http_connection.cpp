#include "app/server/http_connection.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <cerrno>
#include <cstdint>
#include <limits>

namespace dynlab::inline app {
namespace {

namespace http = boost::beast::http;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// Browsers open connections before they ask, and a file whose connection was closed until then is one that the page
/// lacks.
constexpr auto kIdle = 10s, kWholeHead = 10s, kPartOfBody = 10s, kPartOfReply = 10s;
constexpr std::size_t kMaxHeadBytes = std::size_t{64} << 10, kMaxFields = 100;
constexpr auto kLastBytes = 1s;  // for what a refused request still sends
constexpr std::size_t kMaxLastBytes = std::size_t{16} << 20;

LastReply refusal(int status, const char* text) {
    return {{status, kPlainText, text}};
}

std::string decoded(std::string_view text, bool plus_is_blank) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '+' && plus_is_blank) {
            plain += ' ';
        } else if (text[i] != '%') {
            plain += text[i];
        } else {
            if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0)
                throw refusal(400, "The address is not encoded correctly.");
            plain += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        }
    }
    if (plain.find('\0') != std::string::npos) throw refusal(400, "The address is not encoded correctly.");
    return plain;
}

void read_target(std::string_view target, RequestHead& head) {
    const std::size_t mark = target.find('?');
    head.path = decoded(target.substr(0, mark), false);
    if (!head.path.starts_with('/')) throw refusal(400, "The address does not start with a slash.");
    if (mark == target.npos) return;
    std::string_view rest = target.substr(mark + 1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
        const std::size_t equals = std::min(pair.find('='), pair.size());
        if (pair.empty()) continue;
        head.parameters.emplace(decoded(pair.substr(0, equals), true),
                                decoded(pair.substr(std::min(equals + 1, pair.size())), true));
    }
}

using HeadParser = http::request_parser<http::empty_body>;

RequestHead head_of(const HeadParser& parser) {
    const auto& request = parser.get();
    RequestHead head;
    head.method = std::string(request.method_string());
    read_target({request.target().data(), request.target().size()}, head);
    for (const auto& field : request) {
        std::string name(field.name_string());
        std::transform(name.begin(), name.end(), name.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
        head.fields.emplace(std::move(name), std::string(field.value()));
        if (head.fields.size() > kMaxFields) throw refusal(431, "The request has too many fields.");
    }
    head.keeps_alive = parser.keep_alive();
    if (!parser.chunked()) head.body = parser.content_length() ? static_cast<std::size_t>(*parser.content_length()) : 0;
    return head;
}

const char* reason_of(int status) {
    return http::obsolete_reason(http::int_to_status(static_cast<unsigned>(status))).data();
}

}  // namespace

std::optional<std::string_view> RequestHead::field(const std::string& name) const {
    const auto [first, last] = fields.equal_range(name);
    if (first == last || std::next(first) != last) return {};
    return first->second;
}

HttpConnection::Wait HttpConnection::wait(short events, steady_clock::time_point until) const {
    pollfd waiting[2] = {{socket_.get(), events, 0}, {ending_, POLLIN, 0}};
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - steady_clock::now());
        const int ready = ::poll(waiting, 2, static_cast<int>(std::max(left, 0ms).count()));
        if (ready < 0 && errno == EINTR) continue;
        if (waiting[1].revents != 0) return Wait::kEnding;
        return ready > 0 ? Wait::kReady : Wait::kLate;
    }
}

bool HttpConnection::read_more(steady_clock::time_point until) {
    if (wait(POLLIN, until) != Wait::kReady) return false;
    std::array<char, std::size_t{1} << 14> bytes;
    const ssize_t got = retry_interrupted([&] { return ::recv(socket_.get(), bytes.data(), bytes.size(), 0); });
    if (got <= 0) return false;
    unread_.append(bytes.data(), static_cast<std::size_t>(got));
    return true;
}

std::optional<RequestHead> HttpConnection::next_head() {
    if (unread_.empty() && !read_more(steady_clock::now() + kIdle)) return {};
    const auto until = steady_clock::now() + kWholeHead;
    HeadParser parser;
    parser.header_limit(kMaxHeadBytes);
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // WebServer limits bodies
    for (;;) {
        boost::beast::error_code error;
        const std::size_t used = parser.put(boost::asio::buffer(unread_), error);
        unread_.erase(0, used);
        if (error == http::error::header_limit) throw refusal(431, "The head of the request is too long.");
        if (error && error != http::error::need_more) throw refusal(400, "The request cannot be read.");
        if (parser.is_header_done()) return head_of(parser);
        if (unread_.size() > kMaxHeadBytes) throw refusal(431, "The head of the request is too long.");
        if (!read_more(until)) {
            if (wait(POLLIN, steady_clock::now()) == Wait::kLate) throw refusal(408, "The request came too slowly.");
            return {};
        }
    }
}

std::optional<std::string> HttpConnection::body(std::size_t bytes) {
    while (unread_.size() < bytes)
        if (!read_more(steady_clock::now() + kPartOfBody)) return {};
    std::string body = unread_.substr(0, bytes);
    unread_.erase(0, bytes);
    return body;
}

bool HttpConnection::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const Wait waited = wait(POLLOUT, steady_clock::now() + kPartOfReply);
        if (waited == Wait::kLate) return false;
        const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno != EINTR && (errno != EAGAIN || waited == Wait::kEnding)) return false;
        if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

bool HttpConnection::reply(const HttpReply& reply, bool closes, bool without_body) {
    std::string text =
        fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: {}\r\n{}", reply.status,
                    reason_of(reply.status), reply.type, reply.body.size(), closes ? "close" : "keep-alive", fields_);
    for (const auto& [name, value] : reply.fields) text += name + ": " + value + "\r\n";
    text += "\r\n";
    constexpr std::size_t kTogether = std::size_t{1} << 16;  // one packet rather than two
    if (without_body) return write(text);
    if (reply.body.size() <= kTogether) return write(text + reply.body);
    return write(text) && write(reply.body);
}

bool HttpConnection::begin_stream(const std::string& type) {
    return write(fmt::format("HTTP/1.1 200 OK\r\nContent-Type: {}\r\nConnection: close\r\n{}\r\n", type, fields_));
}

bool HttpConnection::is_open() const {
    char next = 0;
    const ssize_t got = ::recv(socket_.get(), &next, 1, MSG_PEEK | MSG_DONTWAIT);
    return got < 0 && (errno == EAGAIN || errno == EINTR);
}

void HttpConnection::close() {
    ::shutdown(socket_.get(), SHUT_WR);
    const auto until = steady_clock::now() + kLastBytes;
    for (std::size_t read = 0; read < kMaxLastBytes; read += unread_.size()) {
        unread_.clear();
        if (!read_more(until)) break;
    }
    unread_.clear();
}

}  // namespace dynlab::inline app
