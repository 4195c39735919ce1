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

    /// The server's name with its port, "dynlab-1f3a...localhost:20123". Browsers resolve every name below localhost to
    /// this machine (RFC 6761) and treat the pages of each name as a separate site.
    std::string host() const;
    /// An address for one visit within a minute.
    std::string address() const;
    std::string text() const;                                            ///< of a file
    static std::optional<EntranceKey> of_text(const std::string& text);  ///< nothing for another text
};

/// Decides who may ask a server of pages on 127.0.0.1, which every user of the machine and every site in the user's
/// browser can reach.
///
/// * Each start of a server has a random name, which is a separate site for browsers. Data that another server at this
///   port left in the browser (cookies, storage, service workers) belong to another site, and browsers send the cookie
///   of this server to no other.
/// * The printed address contains a token for one visit. The visitor gets a cookie (SameSite=Strict, HttpOnly) and is
///   redirected to the page.
/// * `Host` must be that name, so that no other name leads here (DNS rebinding).
/// * No other site may ask: a foreign `Origin` and a `Sec-Fetch-Site` of another site are refused.
/// * A request that changes something (POST) needs the server's `Origin`, `Sec-Fetch-Site: same-origin` and `X-Dynlab:
///   1`, a field that no form can send.
/// * Only POST requests have bodies, and each states its length.
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
    std::int64_t last_report_ = 0;
};

}  // namespace dynlab::inline app
