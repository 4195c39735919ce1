#include "workflow/site/site_manifest.h"

#include <nlohmann/json.hpp>

#include "platform/hash.h"

namespace dynlab::inline workflow {
namespace {

constexpr std::size_t kDigits = 16;

}  // namespace

std::string web_manifest() {
    const nlohmann::json manifest = {{"name", "System identification with dynlab"},
                                     {"short_name", "dynlab"},
                                     {"start_url", "index.html"},
                                     {"scope", "./"},
                                     {"display", "standalone"},
                                     {"background_color", "#ffffff"},
                                     {"theme_color", "#12446b"},
                                     {"icons", {{{"src", "icon.svg"}, {"sizes", "any"}, {"type", "image/svg+xml"}}}}};
    return manifest.dump(1) + "\n";
}

std::string list_of_files(const SiteFiles& files) {
    nlohmann::json list = nlohmann::json::array();
    Sha256 all;
    for (const auto& [name, content] : files) {
        if (name == "sw.js") continue;
        const std::string hash = sha256_of(content);
        all.add(name + "\n" + hash + "\n");
        list.push_back({{"path", name}, {"bytes", content.size()}, {"sha256", hash.substr(0, kDigits)}});
    }
    return nlohmann::json({{"version", all.hex().substr(0, kDigits)}, {"files", list}}).dump() + "\n";
}

}  // namespace dynlab::inline workflow
