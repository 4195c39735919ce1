#include "course/similarity/similarity.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "course/grading/feedback.h"
#include "course/similarity/fingerprints.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kFewest = 8;         // fingerprints in common, about thirty tokens
constexpr double kLeastEvidence = 1.5;     // their weight: as if so many stood in no third script
constexpr double kNearlyAll = 0.95;        // a share so large is told however many have that code,
constexpr std::size_t kManyInCommon = 40;  // if it is so much of it
constexpr std::size_t kGap = 3;            // fingerprints that may lie between two of one passage
constexpr std::size_t kMostPassages = 3, kMostLines = 30;

using Hashes = std::unordered_set<std::uint64_t>;

Hashes set_of(const std::vector<Fingerprint>& prints) {
    Hashes hashes;
    for (const Fingerprint& print : prints) hashes.insert(print.hash);
    return hashes;
}

std::set<std::string> own_lines(const std::string& source, const std::set<std::string>& starter) {
    std::set<std::string> lines;
    for (const std::string& line : lines_of(source)) {
        const std::string text = trimmed(line);
        if (text.size() > 3 && !text.starts_with("--") && !starter.contains(text)) lines.insert(text);
    }
    return lines;
}

class ScriptComparison {
  public:
    ScriptComparison(const std::vector<ComparedScript>& scripts, const std::string& starter) : scripts_(scripts) {
        const Hashes given = set_of(fingerprints(starter));
        starter_lines_ = own_lines(starter, {});
        std::set<std::vector<std::uint64_t>> seen;
        for (const ComparedScript& script : scripts) {
            std::vector<Fingerprint> own = fingerprints(script.source);
            std::erase_if(own, [&](const Fingerprint& print) { return given.contains(print.hash); });
            std::vector<std::uint64_t> stream;
            for (const Fingerprint& print : own) stream.push_back(print.hash);
            Hashes hashes = set_of(own);
            // Copies count once: else what the whole class copied would look like what everybody writes.
            if (seen.insert(std::move(stream)).second)
                for (const std::uint64_t hash : hashes) ++holders_[hash];
            prints_.push_back(std::move(own));
            hashes_.push_back(std::move(hashes));
            lines_.push_back(own_lines(script.source, starter_lines_));
        }
    }

    std::vector<SimilarPair> pairs(double line) const {
        std::vector<double> weights;
        for (const Hashes& hashes : hashes_) weights.push_back(weight_of(hashes));
        std::vector<SimilarPair> found;
        for (std::size_t a = 0; a < scripts_.size(); ++a) {
            if (!scripts_[a].of_class) continue;
            for (std::size_t b = 0; b < scripts_.size(); ++b) {
                if (a == b || (scripts_[b].of_class && b < a)) continue;
                const auto [count, weight] = common(hashes_[a], hashes_[b]);
                const double whole = std::min(weights[a], weights[b]), share = whole > 0 ? weight / whole : 0;
                const bool enough = weight >= kLeastEvidence || (share >= kNearlyAll && count >= kManyInCommon);
                if (count < kFewest || !enough || share < line) continue;
                found.push_back({a, b, std::min(share, 1.0), same_lines(a, b), {}});
            }
        }
        std::ranges::stable_sort(found, [](const SimilarPair& x, const SimilarPair& y) { return x.share > y.share; });
        for (std::size_t k = 0; k < std::min(found.size(), kMostShownPairs); ++k)
            found[k].passages = passages(found[k].a, found[k].b);
        return found;
    }

  private:
    double weight_of(std::uint64_t hash) const { return 1.0 / std::max(1, holders_.at(hash)); }
    double weight_of(const Hashes& hashes) const {
        double sum = 0;
        for (const std::uint64_t hash : hashes) sum += weight_of(hash);
        return sum;
    }

    std::pair<std::size_t, double> common(const Hashes& a, const Hashes& b) const {
        const Hashes &fewer = a.size() < b.size() ? a : b, &more = a.size() < b.size() ? b : a;
        std::size_t count = 0;
        double weight = 0;
        for (const std::uint64_t hash : fewer)
            if (more.contains(hash)) ++count, weight += weight_of(hash);
        return {count, weight};
    }

    double same_lines(std::size_t a, std::size_t b) const {
        const auto &one = lines_[a], &other = lines_[b];
        const auto &fewer = one.size() < other.size() ? one : other, &more = one.size() < other.size() ? other : one;
        const auto same = std::ranges::count_if(fewer, [&](const auto& line) { return more.contains(line); });
        return fewer.empty() ? 0 : static_cast<double>(same) / static_cast<double>(fewer.size());
    }

    /// Runs of common fingerprints in the order of both.
    std::vector<CommonPassage> passages(std::size_t a, std::size_t b) const {
        std::unordered_map<std::uint64_t, std::vector<std::size_t>> places;
        for (std::size_t k = 0; k < prints_[b].size(); ++k) places[prints_[b][k].hash].push_back(k);
        std::vector<CommonPassage> all;
        for (std::size_t k = 0; k < prints_[a].size();) {
            const auto start = places.find(prints_[a][k].hash);
            if (start == places.end()) {
                ++k;
                continue;
            }
            std::size_t end = k + 1;
            CommonPassage longest;
            for (const std::size_t place : start->second) {
                const auto [passage, behind] = passage_from(a, k, b, place, places);
                if (passage.fingerprints <= longest.fingerprints) continue;
                longest = passage;
                end = behind;
            }
            all.push_back(longest);
            k = end;
        }
        std::ranges::stable_sort(
            all, [](const CommonPassage& x, const CommonPassage& y) { return x.fingerprints > y.fingerprints; });
        if (all.size() > kMostPassages) all.resize(kMostPassages);
        return all;
    }

    /// The passage that starts at these two fingerprints, and where it ends in a.
    std::pair<CommonPassage, std::size_t> passage_from(
        std::size_t a, std::size_t i, std::size_t b, std::size_t j,
        const std::unordered_map<std::uint64_t, std::vector<std::size_t>>& places) const {
        CommonPassage passage{prints_[a][i].first_line, prints_[a][i].last_line, prints_[b][j].first_line,
                              prints_[b][j].last_line, 1};
        std::size_t end = i + 1;
        for (std::size_t next = i + 1; next < prints_[a].size() && next <= end + kGap; ++next) {
            const auto found = places.find(prints_[a][next].hash);
            if (found == places.end()) continue;
            const auto place = std::ranges::upper_bound(found->second, j);
            if (place == found->second.end() || *place > j + 1 + kGap) continue;
            j = *place;
            end = next + 1;
            ++passage.fingerprints;
            passage.last_a = std::max(passage.last_a, prints_[a][next].last_line);
            passage.last_b = std::max(passage.last_b, prints_[b][j].last_line);
        }
        return {passage, end};
    }

    const std::vector<ComparedScript>& scripts_;
    std::set<std::string> starter_lines_;
    std::vector<std::set<std::string>> lines_;
    std::vector<std::vector<Fingerprint>> prints_;
    std::vector<Hashes> hashes_;
    std::unordered_map<std::uint64_t, int> holders_;
};

/// Lines of a script, with their numbers, that no backtick of theirs ends.
std::string quoted_lines(const ComparedScript& script, int first, int last) {
    const std::vector<std::string> lines = lines_of(script.source);
    std::string text = fmt::format("*{}*, lines {} to {}:\n\n", readable_markdown(script.name), first, last);
    int shown = 0;
    for (int number = first; number <= last && number <= static_cast<int>(lines.size()); ++number) {
        if (++shown > static_cast<int>(kMostLines)) return text + "        ...\n\n";
        std::string line = lines[static_cast<std::size_t>(number - 1)];
        std::erase_if(line, [](unsigned char c) { return c < 0x20 && c != '\t'; });
        text += fmt::format("    {:>4}  {}\n", number, line);
    }
    return text + "\n";
}

std::string whole_percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

}  // namespace

std::vector<SimilarPair> similar_pairs(const std::vector<ComparedScript>& scripts, const std::string& starter,
                                       double line) {
    return ScriptComparison(scripts, starter).pairs(line);
}

std::string similarity_in_markdown(const std::vector<ComparedScript>& scripts, const std::vector<SimilarPair>& pairs,
                                   double line) {
    constexpr std::size_t most = kMostShownPairs;
    std::string text = fmt::format(
        "# Scripts that look alike\n\nCompared were {} scripts, without comments, layout and the names that they "
        "chose; what the lesson gave counts for nothing. The pairs that have {} or more of the shorter one's own code "
        "in common are listed. That says nothing of who wrote it, nor whether it was allowed: look at both.\n\n",
        scripts.size(), whole_percent(line));
    if (pairs.empty()) return text + "There are none.\n";
    text += "| first | second | code in common | lines letter by letter |\n|---|---|---|---|\n";
    for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k)
        text += fmt::format("| {} | {} | {} | {} |\n", readable_markdown(scripts[pairs[k].a].name),
                            readable_markdown(scripts[pairs[k].b].name), whole_percent(pairs[k].share),
                            whole_percent(pairs[k].same_lines));
    if (pairs.size() > most) text += fmt::format("\n{} further pairs are in similarity.csv.\n", pairs.size() - most);
    for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k) {
        const SimilarPair& pair = pairs[k];
        text += fmt::format("\n## {} and {}: {}\n\n", readable_markdown(scripts[pair.a].name),
                            readable_markdown(scripts[pair.b].name), whole_percent(pair.share));
        for (const CommonPassage& passage : pair.passages)
            text += quoted_lines(scripts[pair.a], passage.first_a, passage.last_a) +
                    quoted_lines(scripts[pair.b], passage.first_b, passage.last_b);
    }
    return text;
}

}  // namespace dynlab::inline course
