#include "app/kernel/input_history.h"

#include <fnmatch.h>

#include <algorithm>
#include <set>

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr int kSession = 1;

}  // namespace

void InputHistory::add(int count, const std::string& code, const std::string& result) {
    inputs_.push_back({count, code, result});
    if (inputs_.size() > kMax) inputs_.pop_front();
}

json InputHistory::found(const json& request) const {
    const std::string kind = request.value("hist_access_type", "tail");
    const int first = request.value("start", 0), stop = request.value("stop", 0);
    const std::string pattern = request.value("pattern", "*");
    std::vector<const Input*> chosen;
    for (const Input& input : inputs_) {
        const bool in_range = input.count >= first && (stop <= 0 || input.count < stop);
        if (kind == "range" && !in_range) continue;
        if (kind == "search" && ::fnmatch(pattern.c_str(), input.code.c_str(), 0) != 0) continue;
        chosen.push_back(&input);
    }
    if (kind == "search" && request.value("unique", false)) {
        std::set<std::string> seen;
        std::reverse(chosen.begin(), chosen.end());
        std::erase_if(chosen, [&](const Input* input) { return !seen.insert(input->code).second; });
        std::reverse(chosen.begin(), chosen.end());
    }
    const json requested = request.value("n", json());
    const std::size_t max_count = requested.is_number_integer() ? std::max(requested.get<int>(), 0) : kMax;
    if (kind != "range" && chosen.size() > max_count)
        chosen.erase(chosen.begin(), chosen.end() - static_cast<long>(max_count));
    json list = json::array();
    for (const Input* input : chosen) {
        const json code =
            request.value("output", false) ? json::array({input->code, input->result}) : json(input->code);
        list.push_back(json::array({kSession, input->count, code}));
    }
    return list;
}

}  // namespace dynlab::inline app
