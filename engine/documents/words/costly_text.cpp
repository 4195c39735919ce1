#include "documents/words/costly_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

constexpr std::size_t kFarthest = 4000;  // bytes within which a formula or a link's address ends

bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Signs of one paragraph, without those in code and formulas. The weights are of measured times (Pandoc 2.17).
class ParagraphSigns {
  public:
    explicit ParagraphSigns(std::string_view text) : text_(text) {
        find_backticks();
        while (at_ < text_.size()) at_ += step();
    }

    double cost() const {
        constexpr double kFewSigns = 100, kFewLevels = 5, kMostLevels = 60;
        const double levels = static_cast<double>(deepest_) + 0.75 * static_cast<double>(open_titles_);
        const double signs = static_cast<double>(open_tags_ + open_quotes_ + ampersands_) + 0.2 * lone_backticks_;
        return (levels >= kFewLevels ? std::pow(1.6, std::min(levels, kMostLevels)) : 0) +
               (signs > kFewSigns ? 1e-4 * signs * signs : 0);
    }

  private:
    char next(std::size_t ahead = 1) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : ' '; }
    char before() const { return at_ > 0 ? text_[at_ - 1] : ' '; }

    std::size_t run_at(std::size_t at) const { return std::min(text_.find_first_not_of('`', at), text_.size()) - at; }

    /// Where runs of backticks of each length begin.
    void find_backticks() {
        for (std::size_t at = text_.find('`'); at != text_.npos; at = text_.find('`', at + run_at(at)))
            backticks_[run_at(at)].push_back(at);
    }

    /// How many bytes the sign here takes, with what is code or a formula for it.
    std::size_t step() {
        const char c = text_[at_];
        if (c == '\\') return 2;
        if (c == '`') return code();
        if (c == '$') return formula();
        if (c == '[') open();
        if (c == ']') close();
        if (c == '<') ++open_tags_;
        if (c == '>' && open_tags_ > 0) --open_tags_;
        if (c == '&') ++ampersands_;
        if (c == '\'' && is_space(before()) && !is_space(next())) ++open_quotes_;
        if (c == '\'' && !is_space(before()) && !std::isalnum(static_cast<unsigned char>(next())) && open_quotes_ > 0)
            --open_quotes_;
        return 1;
    }

    std::size_t code() {
        const std::size_t run = run_at(at_);
        const std::vector<std::size_t>& all = backticks_[run];
        const auto end = std::upper_bound(all.begin(), all.end(), at_);
        if (end != all.end()) return *end + run - at_;
        lone_backticks_ += static_cast<double>(run);
        return run;
    }

    /// $x$: no space within beside the signs, no digit behind; $$x$$.
    std::size_t formula() {
        const std::string_view rest = text_.substr(at_, kFarthest);
        if (rest.starts_with("$$")) {
            const std::size_t end = rest.find("$$", 2);
            return end == rest.npos ? 2 : end + 2;
        }
        if (is_space(next())) return 1;
        const std::size_t known = searched_ > at_ ? searched_ - at_ : 1;  // until there nothing ends a formula
        for (std::size_t end = rest.find('$', known); end != rest.npos; end = rest.find('$', end + 1))
            if (!is_space(rest[end - 1]) && rest[end - 1] != '\\' &&
                !std::isdigit(static_cast<unsigned char>(next(end + 1))))
                return end + 1;
        searched_ = at_ + rest.size();
        return 1;
    }

    /// A note takes twice as long as a link.
    void open() {
        open_.push_back(before() == '^' ? 2 : 1);
        depth_ += open_.back();
        deepest_ = std::max(deepest_, depth_);
    }

    void close() {
        if (!open_.empty()) depth_ -= open_.back(), open_.pop_back();
        if (next() != '(' && next() != ':') return;
        const std::string_view rest = text_.substr(at_, kFarthest);
        const std::string_view address = rest.substr(0, rest.find(next() == '(' ? ')' : '\n'));
        for (const char quote : {'"', '\''})
            if (const std::size_t title = address.find(std::string(" ") + quote); title != address.npos) {
                const std::size_t last = address.find_last_not_of(" \t\r");
                if (last == title + 1 || address[last] != quote) ++open_titles_;
            }
    }

    std::string_view text_;
    std::size_t at_ = 0, searched_ = 0;
    std::map<std::size_t, std::vector<std::size_t>> backticks_;
    std::vector<std::size_t> open_;
    std::size_t depth_ = 0, deepest_ = 0, open_titles_ = 0, open_tags_ = 0, open_quotes_ = 0, ampersands_ = 0;
    double lone_backticks_ = 0;
};

/// {.lua #name key=value}: Pandoc takes other braces, and what lies behind them, for text.
bool are_attributes(std::string_view braces) {
    if (braces.size() < 2 || braces.front() != '{' || braces.back() != '}') return false;
    const auto words = words_between_spaces(braces.substr(1, braces.size() - 2));
    const auto is_plain = [](std::string_view word) { return is_name(word); };
    return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
        const std::size_t sign = word.find('=');
        if (sign == word.npos) return (word[0] == '.' || word[0] == '#') && is_plain(word.substr(1));
        return is_plain(word.substr(0, sign)) && sign + 1 < word.size() &&
               std::all_of(word.begin() + static_cast<std::ptrdiff_t>(sign) + 1, word.end(),
                           [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; });
    });
}

/// The length of the fence with which a line begins fenced code; 0 where it does not.
std::size_t fence_of(std::string_view line) {
    const std::size_t fence = std::min(line.find_first_not_of('`'), line.size());
    const std::string word = trimmed(line.substr(fence));
    return fence >= 3 && (word.empty() || is_name(word) || are_attributes(word)) ? fence : 0;
}

/// Behind the last line of the code that begins with this one; `from` where nothing ends it.
std::size_t end_of_code(const std::vector<std::string_view>& lines, std::size_t from) {
    const std::size_t fence = fence_of(lines[from]);
    for (std::size_t i = from + 1; i < lines.size(); ++i) {
        const std::size_t run = std::min(lines[i].find_first_not_of('`'), lines[i].size());
        if (run >= fence && is_blank(lines[i].substr(run))) return i + 1;
    }
    return from;
}

}  // namespace

Message CostlyText::complaint() {
    return Message(
        "Pandoc would take minutes for this paragraph: too much in it opens and is never closed, or lies within each "
        "other ([, ^[, ](, <, &, ' or `); close it, or put a backslash before a sign that stands for itself");
}

std::optional<int> CostlyText::line_of(std::string_view markdown) {
    const std::vector<std::string_view> lines = lines_with_ends(markdown);
    bool fences_end = true;  // one that nothing ends is looked for once
    const auto is_fence = [&](std::size_t i) { return fences_end && fence_of(lines[i]) > 0; };
    for (std::size_t i = 0; i < lines.size();) {
        if (is_blank(lines[i])) {
            ++i;
            continue;
        }
        if (is_fence(i)) {
            const std::size_t end = end_of_code(lines, i);
            fences_end = end > i;
            i = end;
            if (fences_end) continue;
        }
        const std::size_t first = i;
        std::size_t bytes = 0;
        do bytes += lines[i++].size();
        while (i < lines.size() && !is_blank(lines[i]) && !is_fence(i));
        left_ -= ParagraphSigns(std::string_view(lines[first].data(), bytes)).cost();
        if (left_ < 0) return static_cast<int>(first) + 1;
    }
    return {};
}

}  // namespace dynlab::inline documents
