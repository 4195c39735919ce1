#include "course/anonymity/pattern_matcher.h"

#include <algorithm>

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMinJoinedLength = 7;   ///< letters of a whole name written as one word
constexpr std::size_t kMinGroupedDigits = 7;  ///< digits of a number that is written in groups
constexpr std::size_t kMaxPrefixLength = 3;   ///< letters before an account's short number
constexpr std::size_t kMinPluralLength = 5;   ///< letters of a surname

using Tokens = std::vector<NameToken>;

bool is_among(const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::any_of(words, [&word](const char* one) { return word == one; });
}

bool is_label(const NameToken& token) {
    return is_among(token.letters,
                    {"student", "students", "id", "number", "nr", "no", "etudiant", "etudiants", "etudiante", "numero",
                     "matricule", "author", "authors", "auteur", "auteure", "auteurs", "group", "groupe"});
}

/// One try to read a pattern at a token.
class PatternMatcher {
  public:
    PatternMatcher(const NamePattern& pattern, const Tokens& tokens, std::size_t first, std::string_view text,
                   TextManner manner)
        : pattern_(pattern),
          tokens_(tokens),
          first_(first),
          next_(first),
          text_(text),
          strict_(pattern.initialled || pattern.connected ||
                  (manner == TextManner::kProse && pattern.capital && pattern.whole)) {}

    std::optional<PatternMatch> match() {
        while (read_ < pattern_.letters.size()) {
            if (next_ == tokens_.size()) return {};
            if (skips_initial() || skips_connection() || skips_number_sign()) ++next_;
            if (next_ == tokens_.size() || !takes(tokens_[next_])) return {};
        }
        if (pattern_.kind != NameKind::kName && !is_separate_word()) return {};
        return PatternMatch{next_, parted_};
    }

  private:
    bool at_break() const { return pattern_.breaks.contains(read_); }

    /// "Ada M. Lovelace".
    bool skips_initial() const {
        if (pattern_.kind != NameKind::kName || read_ == 0 || !at_break() || next_ + 1 >= tokens_.size()) return false;
        const NameToken& token = tokens_[next_];
        return token.letters.size() == 1 && !token.digits && token.capital && token.gap != Gap::kWide &&
               pattern_.letters[read_] != token.letters.front();
    }

    /// "Wu and Li".
    bool skips_connection() const {
        if (!pattern_.connected || read_ == 0 || !at_break()) return false;
        const NameToken& token = tokens_[next_];
        return token.gap == Gap::kSpace && is_among(token.letters, {"and", "et", "und", "with", "y", "e"});
    }

    /// "Groupe n° 7".
    bool skips_number_sign() const {
        return pattern_.kind == NameKind::kGroup && read_ > 0 && at_break() &&
               is_among(tokens_[next_].letters, {"n", "no", "nr", "num", "number", "numero"});
    }

    /// "2021 4711", "2021-4711", "2021/4711", "20,214,711".
    bool is_grouped(const NameToken& token) const {
        const NameToken& before = tokens_[next_ - 1];
        if (pattern_.kind != NameKind::kNumber || !token.digits || !before.digits) return false;
        if (token.letters.size() < 2 || before.letters.size() < 2 || pattern_.letters.size() < kMinGroupedDigits)
            return false;
        const std::string_view between = text_.substr(before.end, token.begin - before.end);
        const bool thousands =
            token.letters.size() == 3 && (between == "," || between == "." || between == "'" || between == "\u2019");
        return thousands || between == "-" || between == "/" ||
               (token.gap == Gap::kSpace && between.size() <= 3 && between.find('\n') == std::string_view::npos);
    }

    bool gap_fits(const NameToken& token) const {
        if (next_ == first_) return true;
        if (at_break()) return token.gap != Gap::kWide && (pattern_.spaced || token.gap != Gap::kSpace);
        if (token.gap == Gap::kNone || token.gap == Gap::kBreak || is_grouped(token)) return true;
        return token.gap == Gap::kSpace && pattern_.kind == NameKind::kName &&
               pattern_.letters.size() >= kMinJoinedLength;
    }

    /// "Lovelaces", "Lovelace's" without its apostrophe.
    bool is_plural(const NameToken& token) const {
        const std::string_view rest = std::string_view(pattern_.letters).substr(read_);
        return pattern_.kind == NameKind::kName && !pattern_.given_only && rest.size() >= kMinPluralLength &&
               token.letters.size() == rest.size() + 1 && token.letters.ends_with('s') &&
               token.letters.starts_with(rest);
    }

    bool takes(const NameToken& token) {
        const bool plural = is_plural(token);
        if (!plural && pattern_.letters.compare(read_, token.letters.size(), token.letters) != 0) return false;
        if (!gap_fits(token)) return false;
        const bool apart = next_ > first_ && !at_break() && token.gap == Gap::kSpace && !is_grouped(token);
        // Letters set apart, alone or in pairs: "L O V E L A C E".
        parted_ = parted_ || (apart && (token.letters.size() > 2 || tokens_[next_ - 1].letters.size() > 2));
        const bool begins_part = read_ == 0 || at_break();
        if (strict_ && begins_part && !token.capital && !token.digits) return false;
        const auto inside = pattern_.breaks.upper_bound(read_);
        const bool joined = inside != pattern_.breaks.end() && *inside < read_ + token.letters.size();
        if (joined && pattern_.letters.size() < kMinJoinedLength) return false;
        read_ += token.letters.size() - (plural ? 1 : 0);
        ++next_;
        return true;
    }

    /// Of a number that cannot be mistaken, and of the authors' own group: "20214711b", "group1data"; not "20214711e5".
    bool may_touch_letters() const {
        const NameToken& behind = tokens_[next_];
        const bool power = behind.letters == "e" && next_ + 1 < tokens_.size() && tokens_[next_ + 1].gap == Gap::kNone;
        if (behind.digits || power || !tokens_[next_ - 1].digits) return false;
        return pattern_.kind == NameKind::kGroup ? pattern_.own
                                                 : pattern_.kind == NameKind::kNumber && !pattern_.labeled;
    }

    /// A number is not part of a longer one and has no decimals. Accounts have letters before it: "s20214711".
    bool is_separate_word() const {
        if (next_ < tokens_.size() && tokens_[next_].gap == Gap::kNone && !may_touch_letters()) return false;
        if (first_ == 0 || tokens_[first_].gap != Gap::kNone) return true;
        const NameToken& before = tokens_[first_ - 1];
        const bool is_account = pattern_.kind == NameKind::kNumber && tokens_[first_].digits && !before.digits &&
                                (first_ == 1 || before.gap != Gap::kNone);
        return is_account && (!pattern_.labeled || before.letters.size() <= kMaxPrefixLength || is_label(before));
    }

    const NamePattern& pattern_;
    const Tokens& tokens_;
    std::size_t first_, next_, read_ = 0;
    std::string_view text_;
    bool strict_;  ///< every part begins with a capital
    bool parted_ = false;
};

}  // namespace

std::optional<PatternMatch> match_pattern(const NamePattern& pattern, const Tokens& tokens, std::size_t first,
                                          std::string_view text, TextManner manner) {
    return PatternMatcher(pattern, tokens, first, text, manner).match();
}

bool is_labeled(const Tokens& tokens, std::size_t first) {
    for (std::size_t back = 1; back <= 2 && back <= first; ++back)
        if (is_label(tokens[first - back])) return true;
    return false;
}

}  // namespace dynlab::inline course
