#include "documents/words/costly_text.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// Signs of the lines between two blank ones. Code and formulas count as well: only Pandoc knows where they begin.
class ParagraphSigns {
  public:
    explicit ParagraphSigns(std::string_view text) : text_(text) {
        for (at_ = 0; at_ < text_.size(); ++at_) take_sign();
    }

    /// Whether the time doubles with each sign, and how many there are.
    bool doubles() const { return deepest_title_ > kMaxLevels || deepest_quotes_ > kMaxLevels; }
    /// Those whose time grows with the square of their number.
    double signs() const { return links_ + 0.2 * backticks_ + brackets_ + tags_ + quotes_ + ampersands_; }

  private:
    static constexpr std::size_t kMaxLevels = 12;  // of which Pandoc 2.17 reads some 50 in a second

    char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : ' '; }
    char before() const { return at_ > 0 ? text_[at_ - 1] : ' '; }

    void take_sign() {
        const char c = text_[at_];
        const auto close = [](double& open) { open = std::max(open - 1, 0.0); };
        if (c == '\\') {
            ++at_;
        } else if (c == '[') {
            ++brackets_;
        } else if (c == ']') {
            close(brackets_);
            if (next() == '(' || next() == ':') take_link();
        } else if (c == '<' && !is_space(next())) {
            ++tags_;
        } else if (c == '>') {
            close(tags_);
        } else if (c == '&' && is_word(next())) {
            ++ampersands_;
        } else if (c == '`') {
            ++backticks_;
        } else if (c == '"' || c == '\'') {
            take_quote(c);
        }
    }

    /// Single quotes in double ones in single ones.
    void take_quote(char c) {
        if (is_space(before()) && !is_space(next())) {
            if (c == '\'') ++quotes_;
            if (open_quotes_.empty() || open_quotes_.back() != c) open_quotes_ += c;
            deepest_quotes_ = std::max(deepest_quotes_, open_quotes_.size());
        } else if (!is_space(before()) && !is_word(next())) {
            if (c == '\'') quotes_ = std::max(quotes_ - 1, 0.0);
            if (!open_quotes_.empty() && open_quotes_.back() == c) open_quotes_.pop_back();
        }
    }

    /// [text](address "title") or [name]: address "title".
    void take_link() {
        constexpr std::size_t kFarthest = 4000;  // bytes within which an address ends
        const std::string_view rest = text_.substr(at_ + 2, kFarthest);
        std::size_t end = rest.find(next() == '(' ? ')' : '\n');
        if (next() == '(' && end == rest.npos) links_ += 3;
        if (next() == ':' && end != rest.npos) end = rest.find('\n', end + 1);  // the title may be in a separate line
        const std::string_view address = rest.substr(0, end);
        for (std::size_t quote = address.find_first_of("\"'"); quote != address.npos;
             quote = address.find_first_of("\"'", quote + 1))
            if (quote > 0 && is_space(address[quote - 1])) return take_title(at_ + 2 + quote);
    }

    /// A quote before a letter opens a title in the title, any other closes one.
    void take_title(std::size_t at) {
        constexpr std::size_t kMaxScannedBytes = std::size_t{1} << 24;
        const char quote = text_[at];
        const std::size_t first = at;
        std::size_t depth = 1;
        for (at = text_.find(quote, at + 1); at != text_.npos && depth > 0 && depth <= kMaxLevels;
             at = text_.find(quote, at + 1))
            at + 1 < text_.size() && is_word(text_[at + 1]) ? ++depth : --depth;
        scanned_ += std::min(at, text_.size()) - first;
        deepest_title_ = std::max(deepest_title_, scanned_ > kMaxScannedBytes ? kMaxLevels + 1 : depth);
    }

    std::string_view text_;
    std::size_t at_ = 0, scanned_ = 0, deepest_title_ = 0, deepest_quotes_ = 0;
    double links_ = 0, backticks_ = 0, brackets_ = 0, tags_ = 0, quotes_ = 0, ampersands_ = 0;
    std::string open_quotes_;
};

/// How many more blocks ::: are open behind a line.
int blocks_opened(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t>"), line.size()));
    const std::size_t colons = std::min(line.find_first_not_of(':'), line.size());
    if (colons < 3) return 0;
    return is_blank(line.substr(colons)) ? -1 : 1;
}

}  // namespace

Message CostlyText::complaint() {
    return Message(
        "Pandoc would need minutes for this paragraph, because too many brackets or quotation marks are opened but not "
        "closed ([, ](, :::, <, &, \", ' or `). Close them, or put a backslash before a literal character");
}

std::optional<int> CostlyText::line_of(std::string_view markdown) {
    constexpr double kFewSigns = 100;
    constexpr int kMaxBlocks = 200;
    const std::vector<std::string_view> lines = lines_with_ends(markdown);
    int blocks = 0;
    for (std::size_t i = 0; i < lines.size();) {
        const std::size_t first = i;
        std::size_t bytes = 0;
        for (; i < lines.size() && !is_blank(lines[i]); ++i) {
            bytes += lines[i].size();
            blocks = std::max(blocks + blocks_opened(lines[i]), 0);
            if (blocks > kMaxBlocks) return static_cast<int>(i) + 1;
        }
        const ParagraphSigns signs(std::string_view(lines[first].data(), bytes));
        if (signs.signs() > kFewSigns) left_ -= signs.signs() * signs.signs();
        if (signs.doubles() || left_ < 0) return static_cast<int>(first) + 1;
        while (i < lines.size() && is_blank(lines[i])) ++i;
    }
    return {};
}

}  // namespace dynlab::inline documents
