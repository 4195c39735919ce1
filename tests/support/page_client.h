#pragma once
#include <httplib.h>

#include <stdexcept>
#include <string>

namespace dynlab::test {

/// Asks a server of pages as its own page does, from the address that was printed on.
class PageClient {
  public:
    explicit PageClient(const std::string& address) : host_(address.substr(7, address.find("/?") - 7)) {
        const auto first = client().Get(address.substr(address.find("/?")));
        if (!first || first->status != 200) throw std::runtime_error("the page cannot be visited: " + address);
        const std::string set = first->get_header_value("Set-Cookie");
        cookie_ = set.substr(0, set.find(';'));
        const std::size_t path = set.find("Path=") + 5;
        folder_ = set.substr(path, set.find("/;", path) - path);
    }

    const std::string& host() const { return host_; }      ///< "127.0.0.1:PORT"
    const std::string& folder() const { return folder_; }  ///< "/NAME"
    const std::string& cookie() const { return cookie_; }  ///< "dynlab=VALUE"
    httplib::Client client() const {
        httplib::Client made("http://" + host_);
        made.set_read_timeout(20, 0);
        return made;
    }
    httplib::Headers known() const { return {{"Cookie", cookie_}}; }
    httplib::Headers of_page() const {
        return {
            {"Cookie", cookie_}, {"Origin", "http://" + host_}, {"Sec-Fetch-Site", "same-origin"}, {"X-Dynlab", "1"}};
    }
    /// Paths begin with a slash, within the pages' folder.
    httplib::Result get(const std::string& path) const { return client().Get(folder_ + path, known()); }
    httplib::Result get(const std::string& path, const httplib::ContentReceiver& take) const {
        return client().Get(folder_ + path, known(), take);
    }
    httplib::Result post(const std::string& path, const std::string& body = "{}") const {
        return client().Post(folder_ + path, of_page(), body, "application/json");
    }

  private:
    std::string host_, cookie_, folder_;
};

}  // namespace dynlab::test
