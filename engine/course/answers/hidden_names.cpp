#include "course/answers/hidden_names.h"

#include <algorithm>
#include <string_view>

namespace dynlab::inline course {
namespace {

constexpr std::string_view kHidden = "[name]";

void hide(std::string& text, const IdentityMatcher& names, bool only_certain) {
    constexpr int kMaxRounds = 1000;  // find() reports each person once, so that it is asked again for each place
    for (int round = 0; round < kMaxRounds; ++round) {
        std::vector<NameHit> hits = names.find(text, TextManner::kProse);
        std::erase_if(hits, [&](const NameHit& hit) {
            const bool hidden = hit.begin > 0 && std::string_view(text).substr(hit.begin - 1).starts_with(kHidden);
            return hit.end <= hit.begin || hidden || (only_certain && !hit.certain);
        });
        if (hits.empty()) return;
        const NameHit& first = *std::ranges::min_element(hits, {}, &NameHit::begin);
        text.replace(first.begin, first.end - first.begin, kHidden);
    }
}

}  // namespace

std::string HiddenNames::hidden_in(std::string text, const std::vector<Student>& authors) const {
    IdentityMatcher own;
    for (const Student& author : authors) own.add(author, true);
    if (!own.empty()) hide(text, own, false);
    hide(text, everybody_, true);
    return text;
}

}  // namespace dynlab::inline course
