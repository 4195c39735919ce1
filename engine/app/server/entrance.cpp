#include "app/server/entrance.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "platform/hash.h"
#include "platform/keys/secure_random.h"

namespace dynlab::inline app {
namespace {

/// Long enough for a browser that starts on a busy machine.
constexpr std::int64_t kTokenMilliseconds = 60'000;
constexpr std::size_t kTimeDigits = 12, kNonceDigits = 16, kCodeDigits = 32, kNameDigits = 20;

const char* const kNoEntrance =
    "<!DOCTYPE html><title>dynlab</title><p>This page belongs to a dynlab that runs in a terminal. Open the address "
    "that it printed there. An address works once and for a minute; the terminal shows a new one for a browser that "
    "comes too late.</p>";
constexpr std::int64_t kNextNews = 5'000;  // ms between two late visits that are reported

/// A clock that is the same in all processes of this machine and that no one can set.
std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::string code_of(const std::string& secret, std::string_view time_and_nonce) {
    return hmac_sha256(secret, {time_and_nonce}).substr(0, kCodeDigits);
}

/// Whether "a=1; b=2" has the cookie "b=2".
bool has_cookie(std::string_view cookies, std::string_view requested) {
    while (!cookies.empty()) {
        const std::string_view cookie = cookies.substr(0, cookies.find(';'));
        if (equal_in_constant_time(cookie, requested)) return true;
        cookies.remove_prefix(std::min(cookie.size() + 1, cookies.size()));
        while (cookies.starts_with(' ')) cookies.remove_prefix(1);
    }
    return false;
}

LastReply forbidden(const char* text) {
    constexpr int kForbidden = 403;
    return {{kForbidden, "text/html; charset=utf-8", text}};
}

}  // namespace

std::string EntranceKey::host() const {
    return fmt::format("dynlab-{}.localhost:{}", hmac_sha256(secret, {"host"}).substr(0, kNameDigits), port);
}

std::string EntranceKey::address() const {
    const std::string sealed =
        fmt::format("{:0{}x}{}", now() + kTokenMilliseconds, kTimeDigits, secure_hex(kNonceDigits / 2));
    return fmt::format("http://{}/?token={}{}", host(), sealed, code_of(secret, sealed));
}

std::string EntranceKey::text() const {
    return fmt::format("{} {}\n", port, secret);
}

std::optional<EntranceKey> EntranceKey::of_text(const std::string& text) {
    EntranceKey key;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), key.port);
    const auto at = static_cast<std::size_t>(end - text.data());
    if (error != std::errc() || at + 2 > text.size() || text[at] != ' ' || text.back() != '\n') return {};
    key.secret = text.substr(at + 1, text.size() - at - 2);
    return key;
}

Entrance::Entrance(int port) : key_{port, secure_hex(16)}, cookie_("dynlab=" + secure_hex(16)) {}

void Entrance::admit(const RequestHead& head) {
    const bool visits = head.path == "/" && head.parameters.contains("token");
    check_origin(head, visits);
    const bool changes = head.method == "POST";
    if (!changes && head.method != "GET" && head.method != "HEAD")
        throw LastReply{{405, kPlainText, "Use GET, HEAD or POST."}};
    if (!head.body || head.has("expect") || (changes ? !head.has("content-length") : *head.body != 0))
        throw LastReply{{400, kPlainText, "A body requires POST, its length and nothing else."}};
    const auto [first, last] = head.fields.equal_range("cookie");
    const bool known = std::any_of(first, last, [&](const auto& field) { return has_cookie(field.second, cookie_); });
    if (visits) visit(head, known);
    if (!known) throw forbidden(kNoEntrance);
    const bool from_page =
        head.field("x-dynlab") == "1" && head.field("sec-fetch-site") == "same-origin" && head.has("origin");
    if (changes && !from_page) throw forbidden("Only the page itself may request this.");
}

void Entrance::check_origin(const RequestHead& head, bool visits) const {
    const std::string host = key_.host();
    if (head.field("host") != host) throw forbidden("This is not the address of a dynlab page.");
    if (head.has("origin") && head.field("origin") != "http://" + host)
        throw forbidden("Other sites may not make requests here.");
    // A first visit may come from a file that holds the address: the browser takes it for another site.
    if (head.has("sec-fetch-site") && !visits) {
        const auto site = head.field("sec-fetch-site");
        if (site != "same-origin" && site != "none") throw forbidden("Other sites may not make requests here.");
    }
}

void Entrance::visit(const RequestHead& head, bool known) {
    const std::string& token = head.parameters.at("token");
    const bool ours = is_ours(token);
    if (!ours || head.method != "GET" || (!takes(token) && !known)) {
        const std::lock_guard lock(mutex_);
        late_visit_ = late_visit_ || ours;
        throw forbidden(kNoEntrance);
    }
    // A page of our own that goes on: after a redirect the browser would still count the site that led here, and would
    // hold back the cookie.
    HttpReply reply{200, "text/html; charset=utf-8",
                    "<!DOCTYPE html><title>dynlab</title><meta http-equiv=\"refresh\" content=\"0;url=/\">"};
    reply.fields.emplace_back("Set-Cookie", cookie_ + "; Path=/; SameSite=Strict; HttpOnly");
    throw LastReply{std::move(reply)};
}

bool Entrance::is_ours(const std::string& token) const {
    if (token.size() != kTimeDigits + kNonceDigits + kCodeDigits) return false;
    const std::string sealed = token.substr(0, kTimeDigits + kNonceDigits);
    return equal_in_constant_time(token.substr(sealed.size()), code_of(key_.secret, sealed));
}

/// Whether a token of ours is neither old nor used; it is used then.
bool Entrance::takes(const std::string& token) {
    const std::int64_t end = std::strtoll(token.substr(0, kTimeDigits).c_str(), nullptr, 16), time = now();
    const std::lock_guard lock(mutex_);
    std::erase_if(used_, [time](const auto& used) { return used.second < time; });
    return end >= time && end <= time + kTokenMilliseconds && used_.emplace(token, end).second;
}

bool Entrance::had_late_visit() {
    const std::lock_guard lock(mutex_);
    const std::int64_t time = now();
    if (!std::exchange(late_visit_, false) || time < last_report_ + kNextNews) return false;
    last_report_ = time;
    return true;
}

}  // namespace dynlab::inline app
