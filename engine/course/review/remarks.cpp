#include "course/review/remarks.h"

#include <algorithm>
#include <cctype>

#include "platform/text/plain_words.h"
#include "course/review/text_blocks.h"

namespace dynlab::inline course {
namespace {

/// The words of a heading without a number before them.
std::vector<std::string> title_words(const std::string& heading) {
    std::vector<std::string> words = plain_words(heading);
    while (!words.empty() &&
           std::all_of(words.front().begin(), words.front().end(), [](unsigned char c) { return std::isdigit(c); }))
        words.erase(words.begin());
    return words;
}

bool is_one_of(const std::string& heading, const std::vector<std::string>& titles) {
    const std::vector<std::string> words = title_words(heading);
    return std::ranges::any_of(titles, [&](const std::string& title) { return title_words(title) == words; });
}

}  // namespace

std::vector<Remark> remarks_in(const DocumentText& review, const ReviewForm& form) {
    std::vector<Remark> remarks;
    std::string question, lead;
    bool scores = false;
    for (const TextBlock& block : text_blocks(review)) {
        if (block.heading) {
            question = block.text;
            scores = is_one_of(question, form.scores);
            lead.clear();
            continue;
        }
        if (scores || plain_words(block.text).empty()) continue;
        if (block.text.ends_with(':') && !block.item) {  // what introduces a list
            lead += (lead.empty() ? "" : " ") + block.text;
            continue;
        }
        remarks.push_back({question, lead.empty() ? block.text : lead + " " + block.text, block.page,
                           !is_one_of(question, form.praise)});
        lead.clear();
    }
    if (!lead.empty()) remarks.push_back({question, lead, 1, !is_one_of(question, form.praise)});
    return remarks;
}

ReviewForm review_form() {
    return {{"Greatest strength", "Principale qualité"}, {"Scores", "Notes"}};
}

}  // namespace dynlab::inline course
