#pragma once
#include <httplib.h>

#include <stdexcept>
#include <string>

namespace dynlab::test {

/// Asks a server of pages as its own page does, from the address that was printed on.
class PageClient {
  public:
    explicit PageClient(const std::string& address) : host_(host_of(address)) {
        const auto first = client().Get(address.substr(address.find("/?")));
        if (!first || first->status != 200) throw std::runtime_error("the page cannot be visited: " + address);
        const std::string set = first->get_header_value("Set-Cookie");
        cookie_ = set.substr(0, set.find(';'));
    }

    static std::string host_of(const std::string& address) { return address.substr(7, address.find("/?") - 7); }
    const std::string& host() const { return host_; }      ///< "dynlab-NAME.localhost:PORT"
    const std::string& cookie() const { return cookie_; }  ///< "dynlab=VALUE"
    httplib::Client client() const { return client_of(host_); }
    /// Asks as a browser does: it knows every name below localhost as this machine, which the system need not.
    static httplib::Client client_of(const std::string& host) {
        httplib::Client made("127.0.0.1", std::stoi(host.substr(host.rfind(':') + 1)));
        made.set_default_headers({{"Host", host}});
        made.set_read_timeout(20, 0);
        return made;
    }
    httplib::Headers known() const { return {{"Cookie", cookie_}}; }
    httplib::Headers of_page() const {
        return {
            {"Cookie", cookie_}, {"Origin", "http://" + host_}, {"Sec-Fetch-Site", "same-origin"}, {"X-Dynlab", "1"}};
    }
    /// Paths begin with a slash.
    httplib::Result get(const std::string& path) const { return client().Get(path, known()); }
    httplib::Result get(const std::string& path, const httplib::ContentReceiver& take) const {
        return client().Get(path, known(), take);
    }
    httplib::Result post(const std::string& path, const std::string& body = "{}") const {
        return client().Post(path, of_page(), body, "application/json");
    }

  private:
    std::string host_, cookie_;
};

}  // namespace dynlab::test
