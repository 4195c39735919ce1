#include "documents/complaints.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

/// The lines, with comments replaced by spaces and code between fences left out.
std::string without_comments_and_code(const std::string& text) {
    constexpr std::string_view kOpen = "<!--", kClose = "-->";
    std::string prose;
    FencedCode fence;
    bool in_comment = false;
    for (const std::string_view line : lines_with_ends(text)) {
        if (!in_comment && fence.holds(std::string(line))) {
            prose += trimmed(line).starts_with("```") ? std::string(line) : "\n";
            continue;
        }
        std::string_view rest = line;
        while (!rest.empty()) {
            const std::string_view mark = in_comment ? kClose : kOpen;
            const std::size_t at = rest.find(mark), end = at == rest.npos ? rest.size() : at + mark.size();
            prose += in_comment ? std::string(end, ' ') : std::string(rest.substr(0, end));
            in_comment = in_comment != (at != rest.npos);
            rest.remove_prefix(end);
        }
        if (in_comment) prose += '\n';
    }
    return prose;
}

bool is_key_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

/// Whether the text at `at` is a whole name: @fig:a is not part of @fig:ab or @fig:a-b.
bool is_whole_word(std::string_view text, std::size_t at, std::size_t length) {
    if (at > 0 && is_key_letter(text[at]) && is_key_letter(text[at - 1])) return false;
    if (!is_key_letter(text[at + length - 1])) return true;
    const std::string_view behind = text.substr(at + length);
    if (behind.empty()) return true;
    const bool joined = std::string_view("-:.").find(behind[0]) != std::string_view::npos;
    return !is_key_letter(behind[0]) && !(joined && behind.size() > 1 && is_key_letter(behind[1]));
}

/// The `occurrence`-th line with the words, the last one where there are fewer; 0 where there is none.
int line_with(std::string_view text, const std::string& words, int occurrence, bool alone) {
    int found = 0, number = 0;
    for (const std::string_view line : lines_with_ends(text)) {
        ++number;
        std::size_t at = line.find(words);
        while (alone && at != line.npos && !is_whole_word(line, at, words.size())) at = line.find(words, at + 1);
        if (at == line.npos) continue;
        found = number;
        if (--occurrence == 0) break;
    }
    return found;
}

}  // namespace

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
        lines.items.push_back(plural(messages_.size() - kShown, "and {} more problem", "and {} more problems"));
    }
    throw DocumentError(Message("{}", lines));
}

Place find_in(const MarkdownText& markdown, const std::string& text, const std::filesystem::path& fallback,
              int occurrence) {
    if (text.empty()) return {fallback, 0};
    const std::string prose = without_comments_and_code(markdown.text);
    for (const auto& [searched, alone] : {std::pair(&prose, true), {&prose, false}, {&markdown.text, false}})
        if (const int line = line_with(*searched, text, occurrence, alone); line > 0) return markdown.origin_of(line);
    return {fallback, 0};
}

}  // namespace dynlab::inline documents
