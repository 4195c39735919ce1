#include "course/review/pack_scores.h"

#include <algorithm>
#include <regex>
#include <vector>

#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 1 << 20;
constexpr std::size_t kMostOfTable = 4000;

std::string without_comments(std::string_view text) {
    std::string kept;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        kept += std::string(line.substr(0, line.find("--"))) + '\n';
        at = end + 1;
    }
    return kept;
}

}  // namespace

std::map<std::string, double> scores_in_script(std::string_view script) {
    static const std::regex table(R"((?:^|\n)\s*(?:local\s+)?scores\s*=\s*\{)"),
        entry(R"((\w+)\s*=\s*(\d{1,4}(?:\.\d{1,4})?)\s*[,;\n}])");
    const std::string text = without_comments(script);
    std::smatch begin;
    if (!std::regex_search(text, begin, table)) return {};
    const auto from = static_cast<std::size_t>(begin.position(0) + begin.length(0));
    const std::size_t close = text.find('}', from);
    if (close == std::string::npos || close - from > kMostOfTable) return {};
    const std::string body = text.substr(from, close + 1 - from);
    std::map<std::string, double> scores;
    for (std::sregex_iterator at(body.begin(), body.end(), entry), end; at != end; ++at)
        scores[(*at)[1]] = std::stod((*at)[2]);
    return scores;
}

std::map<std::string, double> scores_in_pack(const fs::path& folder) {
    std::vector<fs::path> scripts;
    for (const auto& found : fs::recursive_directory_iterator(folder))
        if (found.path().filename() == "analysis.lua" && found.is_regular_file() && !found.is_symlink() &&
            found.file_size() <= kMostBytes)
            scripts.push_back(found.path());
    if (scripts.empty()) return {};
    const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
    return scores_in_script(read_file(*std::min_element(
        scripts.begin(), scripts.end(), [&](const fs::path& a, const fs::path& b) { return depth(a) < depth(b); })));
}

}  // namespace dynlab::inline course
