#include "documents/complaints.h"

#include <algorithm>

#include "documents/text_lines.h"

namespace dynlab::inline documents {

void Complaints::add(const Place& where, const Message& sentence) {
    const Message whole = placed(where, sentence);
    if (std::find(messages_.begin(), messages_.end(), whole) == messages_.end()) messages_.push_back(whole);
}

void Complaints::add_all(const Complaints& others) {
    messages_.insert(messages_.end(), others.messages_.begin(), others.messages_.end());
}

void Complaints::throw_if_any() const {
    if (messages_.empty()) return;
    constexpr std::size_t kShown = 10;
    MessageList lines{messages_, Join::kLines};
    if (messages_.size() > kShown) {
        lines.items.resize(kShown);
        lines.items.push_back(Message("and {} more", messages_.size() - kShown));
    }
    throw DocumentError(Message("{}", lines));
}

Place find_in(const MarkdownText& markdown, const std::string& text, const std::filesystem::path& fallback,
              int occurrence) {
    Place found{fallback, 0};
    int number = 0;
    for (const std::string& line : lines_of(markdown.text)) {
        ++number;
        if (text.empty() || line.find(text) == std::string::npos) continue;
        found = markdown.origin_of(number);
        if (--occurrence == 0) break;
    }
    return found;
}

}  // namespace dynlab::inline documents
