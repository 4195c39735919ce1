#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// A script that is compared: one of the class, or one outside the class (the reference solution, former years).
struct ComparedScript {
    std::string name, source;
    bool of_class = true;
};

/// Where two scripts have the same code but for names and layout: lines of either, both ends included.
struct CommonPassage {
    int first_a = 0, last_a = 0, first_b = 0, last_b = 0;
    std::size_t fingerprints = 0;
};

/// Two similar scripts. `share`: the part of the shorter script's fingerprints that the other script has, 0 to 1; rare
/// fingerprints count more. `same_lines`: the shorter script's lines that appear unchanged in the other script.
struct SimilarPair {
    std::size_t a = 0, b = 0;  ///< places in the list; b is the one outside of the class, where one is
    double share = 0, same_lines = 0;
    double share_of_longer = 0;           ///< like `share`, of the longer script's fingerprints
    std::vector<CommonPassage> passages;  ///< the longest first, at most three
};

/// Copies of one script, or a pair that looks alike. A script that looks like several copies is paired with one of
/// them only.
struct SimilarGroup {
    std::vector<std::size_t> members;                       ///< places in the list
    double min_share = 1, max_share = 0, min_lines = 1;     ///< of the pairs of its members
    std::size_t copies_of_first = 0, copies_of_second = 0;  ///< of a pair: further copies, listed as another group
    bool identical = false;                                 ///< byte for byte
    SimilarPair shown;                                      ///< the pair of members that is most alike
    bool has(std::size_t script) const;
};

inline constexpr std::size_t kMaxShownGroups = 100;

/// Every pair whose share is `line` or more, the largest first. Code in `starter`, which all students received, does
/// not count. Common code counts little: the weight of a fingerprint is one over the number of different scripts with
/// it. The result omits pairs that chance explains (a handful of fingerprints, or only common ones) and pairs of two
/// scripts outside the class.
std::vector<SimilarPair> similar_pairs(const std::vector<ComparedScript>& scripts, const std::string& starter,
                                       double line);

/// The pairs as groups. Copies are scripts that are identical, or that a chain of pairs with nearly all code in common
/// joins; three and more are one group, the largest first. Then come the other pairs, the most alike first.
std::vector<SimilarGroup> similar_groups(const std::vector<ComparedScript>& scripts,
                                         const std::vector<SimilarPair>& pairs);

/// The groups for the instructor, as Markdown: names, shares, and of each passage both sides. It says nothing of
/// who did what. At most kMaxShownGroups are shown.
std::string similarity_in_markdown(const std::vector<ComparedScript>& scripts, const std::vector<SimilarGroup>& groups,
                                   double line);

}  // namespace dynlab::inline course
