#include "course/review/pack_scores.h"

#include <re2/re2.h>

#include <algorithm>
#include <vector>

#include "platform/atomic_file.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestScript = 1 << 20;
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

/// Behind the brace of the first statement "scores = {" or "local scores = {" that begins a line.
std::size_t begin_of_scores(const std::string& text) {
    constexpr std::string_view kName = "scores", kLocal = "local", kBlank = " \t\r\n";
    constexpr std::size_t kMostBefore = 200;  // blanks and "local"
    std::size_t line = 0;                     // begin of the line that holds the name
    for (std::size_t at = text.find(kName); at != std::string::npos; at = text.find(kName, at + 1)) {
        for (std::size_t end = text.find('\n', line); end < at; end = text.find('\n', line)) line = end + 1;
        if (at - line > kMostBefore) continue;
        std::string_view before = std::string_view(text).substr(line, at - line);
        const auto word = before.find_first_not_of(kBlank);
        before.remove_prefix(std::min(word, before.size()));
        const bool alone = before.empty() || (before.starts_with(kLocal) && before.size() > kLocal.size() &&
                                              before.find_first_not_of(kBlank, kLocal.size()) == before.npos);
        const std::size_t sign = text.find_first_not_of(kBlank, at + kName.size());
        if (!alone || sign == std::string::npos || text[sign] != '=') continue;
        const std::size_t brace = text.find_first_not_of(kBlank, sign + 1);
        if (brace != std::string::npos && text[brace] == '{') return brace + 1;
    }
    return std::string::npos;
}

}  // namespace

std::map<std::string, double> scores_in_script(std::string_view script) {
    static const RE2 entry(R"((\w+)\s*=\s*(\d{1,4}(?:\.\d{1,4})?)\s*[,;\n}])", RE2::Latin1);
    const std::string text = without_comments(script);
    const std::size_t from = begin_of_scores(text);
    if (from == std::string::npos) return {};
    const std::size_t close = text.find('}', from);
    if (close == std::string::npos || close - from > kMostOfTable) return {};
    const std::string body = text.substr(from, close + 1 - from);
    std::map<std::string, double> scores;
    std::string name;
    double score = 0;
    for (re2::StringPiece rest = body; RE2::FindAndConsume(&rest, entry, &name, &score);) scores[name] = score;
    return scores;
}

std::map<std::string, double> scores_in_pack(const fs::path& folder) {
    std::vector<fs::path> scripts;
    for (const auto& found : fs::recursive_directory_iterator(folder))
        if (found.path().filename() == "analysis.lua" && found.is_regular_file() && !found.is_symlink() &&
            found.file_size() <= kLargestScript)
            scripts.push_back(found.path());
    if (scripts.empty()) return {};
    const auto depth = [](const fs::path& path) { return std::distance(path.begin(), path.end()); };
    return scores_in_script(read_file(*std::min_element(
        scripts.begin(), scripts.end(), [&](const fs::path& a, const fs::path& b) { return depth(a) < depth(b); })));
}

}  // namespace dynlab::inline course
