#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "app/server/http_connection.h"

namespace dynlab::inline app {

/// Opens the pages of a server to everyone who can read it. Keep it in files that only the user can read.
struct EntranceKey {
    int port = 0;
    std::string secret = {};

    /// The server's name with its port, "dynlab-1f3a...localhost:20123". Browsers take every name below localhost for
    /// this machine (RFC 6761) and the pages of each for a site of its own.
    std::string host() const;
    /// An address for one visit within a minute.
    std::string address() const;
    std::string text() const;                                            ///< of a file
    static std::optional<EntranceKey> of_text(const std::string& text);  ///< nothing for another text
};

/// Decides who may ask a server of pages on 127.0.0.1, which every user of the machine and every site in the user's
/// browser can reach.
///
/// * Each start of a server has a random name, which is a site of its own to browsers. What another server at this port
///   left in the browser (cookies, storage, service workers) belongs to another site, and no other server is sent the
///   cookie of this one.
/// * The address that is printed holds a token for one visit. The visit gets a cookie (SameSite=Strict, HttpOnly) and
///   is sent on to the page.
/// * `Host` must be that name, so that no other name leads here (DNS rebinding).
/// * No other site may ask: a foreign `Origin` and a `Sec-Fetch-Site` of another site are refused.
/// * What changes something (POST) needs the own `Origin`, `Sec-Fetch-Site: same-origin` and `X-Dynlab: 1`, a field
///   that no form can send.
/// * Bodies come behind POST only, with their length.
class Entrance {
  public:
    explicit Entrance(int port);

    const EntranceKey& key() const { return key_; }
    /// Throws LastReply: what refuses the request, or what leads a visit with a token to the page.
    void admit(const RequestHead& head);
    /// Whether a visitor came with an address of this server that was used or old, so that a new one should be
    /// printed: at most every 5 s.
    bool had_late_visit();

  private:
    void check_origin(const RequestHead& head, bool visits) const;
    void visit(const RequestHead& head, bool known);
    bool is_ours(const std::string& token) const;
    bool takes(const std::string& token);

    EntranceKey key_;
    std::string cookie_;  ///< "dynlab=VALUE"
    std::mutex mutex_;
    std::map<std::string, std::int64_t> used_;  ///< tokens, with the time from which on they are too old
    bool late_visit_ = false;
    std::int64_t told_ = 0;
};

}  // namespace dynlab::inline app
