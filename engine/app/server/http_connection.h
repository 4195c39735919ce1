#pragma once
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/system_call.h"

namespace dynlab::inline app {

inline constexpr const char* kPlainText = "text/plain; charset=utf-8";

/// The head of a request (RFC 9112), as it came.
struct RequestHead {
    std::string method, path;                        ///< the path without what is behind the question mark, decoded
    std::map<std::string, std::string> parameters;   ///< behind the question mark, decoded
    std::multimap<std::string, std::string> fields;  ///< by their names in lower case
    std::optional<std::size_t> body;                 ///< bytes that follow it; nothing for chunks
    bool keeps_alive = true;

    /// The value of a field that occurs once; nothing if the field is missing or repeated.
    std::optional<std::string_view> field(const std::string& name) const;
    bool has(const std::string& name) const { return fields.contains(name); }
};

struct HttpReply {
    int status = 200;
    std::string type = "text/html; charset=utf-8", body = {};
    std::vector<std::pair<std::string, std::string>> fields = {};
};

/// Thrown: a reply to what is answered before its body is read, or cannot be read at all. The connection is closed
/// behind it, as whatever bytes follow must not be read as a request.
struct LastReply {
    HttpReply reply;
};

/// One connection of a browser: requests and replies one after the other. Nothing waits longer than its time, nor
/// beyond the end of the server.
class HttpConnection {
  public:
    /// `ending` is readable from the end of the server on; `fields` begin every reply.
    HttpConnection(FileDescriptor socket, int ending, const std::string& fields)
        : socket_(std::move(socket)), ending_(ending), fields_(fields) {}

    int socket() const { return socket_.get(); }
    /// The head of the next request: at most 64 kB and 100 fields, all of it within 10 s of its first byte. Nothing
    /// where none begins for 10 s or the browser is gone. Throws LastReply.
    std::optional<RequestHead> next_head();
    /// What follows the head. Nothing where it does not come.
    std::optional<std::string> body(std::size_t bytes);
    /// Whether unexpected bytes arrived: a browser sends no request before it has the reply to the last one.
    bool has_unread() const { return !unread_.empty(); }

    bool reply(const HttpReply& reply, bool closes, bool without_body = false);
    /// The head of a reply whose body lasts until the end of the connection; then its parts.
    bool begin_stream(const std::string& type);
    bool write(std::string_view bytes);
    /// Whether the browser still listens.
    bool is_open() const;
    /// Says that nothing more comes, and lets the browser read that before what it sent unasked breaks the connection.
    void close();

  private:
    enum class Wait { kReady, kLate, kEnding };
    Wait wait(short events, std::chrono::steady_clock::time_point until) const;
    /// Reads what is there into unread_; false at the end of the connection or of the time.
    bool read_more(std::chrono::steady_clock::time_point until);

    FileDescriptor socket_;
    int ending_;
    const std::string& fields_;
    std::string unread_;
};

}  // namespace dynlab::inline app
