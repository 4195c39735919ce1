#include "documents/complaints.h"

#include <algorithm>

#include "documents/error.h"
#include "documents/text_lines.h"

namespace dynlab::inline documents {

void Complaints::add(const SourceLine& where, const std::string& sentence) {
    const std::string line = where.line > 0 ? ":" + std::to_string(where.line) : "";
    const std::string whole = where.file.string() + line + ": " + sentence;
    if (std::find(sentences_.begin(), sentences_.end(), whole) == sentences_.end()) sentences_.push_back(whole);
}

void Complaints::add_all(const Complaints& others) {
    sentences_.insert(sentences_.end(), others.sentences_.begin(), others.sentences_.end());
}

void Complaints::throw_if_any() const {
    if (sentences_.empty()) return;
    constexpr std::size_t kShown = 10;
    std::string message;
    for (std::size_t i = 0; i < std::min(sentences_.size(), kShown); ++i)
        message += (i == 0 ? "" : "\n") + sentences_[i];
    if (sentences_.size() > kShown) message += "\nand " + std::to_string(sentences_.size() - kShown) + " more";
    throw DocumentError(message);
}

SourceLine find_in(const MarkdownText& markdown, const std::string& text, const std::filesystem::path& fallback,
                   int occurrence) {
    SourceLine found{fallback, 0};
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
