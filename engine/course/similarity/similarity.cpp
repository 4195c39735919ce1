#include "course/similarity/similarity.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "course/grading/feedback.h"
#include "course/similarity/fingerprints.h"
#include "documents/text_lines.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMinCount = 8;       // fingerprints in common, about thirty tokens
constexpr double kLeastEvidence = 1.5;     // their weight: as if so many stood in no third script
constexpr double kNearlyAll = 0.95;        // a share so large is reported however many scripts have that code,
constexpr std::size_t kManyInCommon = 40;  // if it is so much of it
constexpr double kCopyOfLonger = 0.8;      // a copy has so much of the longer one's code, too
constexpr std::size_t kGap = 3;            // fingerprints that may lie between two of one passage
constexpr std::size_t kMaxPassages = 3, kMaxLineCount = 30;

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
                if (count < kMinCount || !enough || share < line) continue;
                const double longer = std::max(weights[a], weights[b]);
                found.push_back({a, b, std::min(share, 1.0), same_lines(a, b), std::min(weight / longer, 1.0), {}});
            }
        }
        std::ranges::stable_sort(found, [](const SimilarPair& x, const SimilarPair& y) { return x.share > y.share; });
        std::set<std::pair<std::size_t, std::size_t>> shown;
        for (const SimilarGroup& group : similar_groups(scripts_, found))
            if (shown.size() < kMaxShownGroups) shown.insert({group.shown.a, group.shown.b});
        for (SimilarPair& pair : found)
            if (shown.contains({pair.a, pair.b})) pair.passages = passages(pair.a, pair.b);
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
        if (all.size() > kMaxPassages) all.resize(kMaxPassages);
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
        if (++shown > static_cast<int>(kMaxLineCount)) return text + "        ...\n\n";
        std::string line = lines[static_cast<std::size_t>(number - 1)];
        std::erase_if(line, [](unsigned char c) { return c < 0x20 && c != '\t'; });
        text += fmt::format("    {:>4}  {}\n", number, line);
    }
    return text + "\n";
}

std::string whole_percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

std::string percent_range(double low, double high) {
    const std::string from = whole_percent(low), to = whole_percent(high);
    return from == to ? to : fmt::format("{:.0f} to {}", 100 * low, to);
}

/// Scripts joined by pairs.
class Components {
  public:
    explicit Components(std::size_t count) : parent_(count), size_(count, 1) {
        for (std::size_t i = 0; i < count; ++i) parent_[i] = i;
    }
    std::size_t of(std::size_t i) const {
        while (parent_[i] != i) i = parent_[i];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        if (a == b) return;
        if (size_[a] < size_[b]) std::swap(a, b);  // keeps paths short
        parent_[b] = a;
        size_[a] += size_[b];
    }
    std::size_t size(std::size_t i) const { return size_[of(i)]; }

  private:
    std::vector<std::size_t> parent_, size_;
};

std::string names_of(const std::vector<ComparedScript>& scripts, const SimilarGroup& group) {
    std::vector<std::string> names;
    for (const std::size_t member : group.members) names.push_back(readable_markdown(scripts[member].name));
    if (names.size() > 2) return fmt::format("{}", fmt::join(names, ", "));
    const auto with_copies = [](const std::string& name, std::size_t copies) {
        return copies == 0 ? name : fmt::format("{} ({} further copies: see above)", name, copies);
    };
    return with_copies(names[0], group.copies_of_first) + " and " + with_copies(names[1], group.copies_of_second);
}

std::string heading_of(const std::vector<ComparedScript>& scripts, const SimilarGroup& group) {
    const std::string share = percent_range(group.min_share, group.max_share);
    if (group.members.size() == 2) return fmt::format("{}: {}", names_of(scripts, group), share);
    const std::string first = readable_markdown(scripts[group.members[0]].name);
    return fmt::format("{} and {} others: {}", first, group.members.size() - 1,
                       group.identical ? "identical files" : share);
}

}  // namespace

bool SimilarGroup::has(std::size_t script) const {
    return std::ranges::find(members, script) != members.end();
}

std::vector<SimilarPair> similar_pairs(const std::vector<ComparedScript>& scripts, const std::string& starter,
                                       double line) {
    return ScriptComparison(scripts, starter).pairs(line);
}

std::vector<SimilarGroup> similar_groups(const std::vector<ComparedScript>& scripts,
                                         const std::vector<SimilarPair>& pairs) {
    Components copies(scripts.size());
    for (const SimilarPair& pair : pairs)
        if (pair.share >= kNearlyAll && pair.share_of_longer >= kCopyOfLonger) copies.join(pair.a, pair.b);
    std::vector<SimilarGroup> groups;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> place;  // in `groups`, by what the pair joins
    const auto further_copies = [&](std::size_t script) {
        return copies.size(script) > 2 ? copies.size(script) - 1 : 0;
    };
    const auto part_of = [&](std::size_t script) { return copies.size(script) > 2 ? copies.of(script) : script; };
    for (const SimilarPair& pair : pairs) {
        const std::size_t a = part_of(pair.a), b = part_of(pair.b);
        const auto [found, fresh] = place.try_emplace(std::minmax(a, b), groups.size());
        if (fresh) {
            SimilarGroup& group = groups.emplace_back();
            group.shown = pair;
            group.identical = true;
            if (a == b)
                for (std::size_t script = 0; script < scripts.size(); ++script)
                    if (part_of(script) == a) group.members.push_back(script);
            if (a != b) {
                group.members = {pair.a, pair.b};
                group.copies_of_first = further_copies(pair.a);
                group.copies_of_second = further_copies(pair.b);
            }
            for (const std::size_t member : group.members)
                group.identical = group.identical && scripts[member].source == scripts[group.members[0]].source;
        }
        SimilarGroup& group = groups[found->second];
        group.min_share = std::min(group.min_share, pair.share);
        group.max_share = std::max(group.max_share, pair.share);
        group.min_lines = std::min(group.min_lines, pair.same_lines);
    }
    std::ranges::stable_sort(groups, [](const SimilarGroup& x, const SimilarGroup& y) {
        const bool large_x = x.members.size() > 2, large_y = y.members.size() > 2;
        if (large_x || large_y) return x.members.size() > y.members.size();
        return x.max_share > y.max_share;
    });
    return groups;
}

std::string similarity_in_markdown(const std::vector<ComparedScript>& scripts, const std::vector<SimilarGroup>& groups,
                                   double line) {
    constexpr std::size_t max_shown = kMaxShownGroups;
    std::string text = fmt::format(
        "# Similar scripts\n\n{} scripts were compared without comments, layout and chosen names; code of the starter "
        "does not count. The list contains copies, and pairs with {} or more of the shorter script's own code in "
        "common. Similarity does not show who wrote the code, or whether sharing it was allowed: inspect both "
        "sides.\n\n",
        scripts.size(), whole_percent(line));
    if (groups.empty()) return text + "There are none.\n";
    text += "| scripts | code in common | identical lines |\n|---|---|---|\n";
    for (std::size_t k = 0; k < std::min(max_shown, groups.size()); ++k) {
        const SimilarGroup& group = groups[k];
        text += fmt::format("| {} | {} | {} |\n", names_of(scripts, group),
                            group.identical ? "identical files" : percent_range(group.min_share, group.max_share),
                            group.members.size() > 2 && !group.identical ? whole_percent(group.min_lines) + " or more"
                                                                         : whole_percent(group.min_lines));
    }
    if (groups.size() > max_shown)
        text += fmt::format("\n{} further pairs are in similarity.csv.\n", groups.size() - max_shown);
    for (std::size_t k = 0; k < std::min(max_shown, groups.size()); ++k) {
        const SimilarGroup& group = groups[k];
        text += fmt::format("\n## {}\n\n", heading_of(scripts, group));
        for (const CommonPassage& passage : group.shown.passages) {
            text += quoted_lines(scripts[group.shown.a], passage.first_a, passage.last_a);
            if (!group.identical) text += quoted_lines(scripts[group.shown.b], passage.first_b, passage.last_b);
        }
    }
    return text;
}

}  // namespace dynlab::inline course
