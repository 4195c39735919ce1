#include "platform/text/name_tokens.h"

#include "platform/text/look_alikes.h"
#include "platform/utf8.h"

namespace dynlab::inline platform {
namespace {

constexpr std::size_t kMinWidth = 3;  ///< signs

bool is_unseen(char32_t c) {
    return c == ' ' || (c >= '\t' && c <= '\r') || c == 0xA0 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F ||
           c == 0x3000;
}

constexpr char32_t kHyphenation = 0xAD;

bool is_hyphen(char32_t c) {
    return c == '-' || c == 0x2010 || c == 0x2011 || c == kHyphenation;
}

bool is_line_end(char32_t c) {
    return c == '\n' || c == '\r';
}

/// A soft hyphen is a sign where a line ends behind it.
bool is_unheard(char32_t c, std::string_view rest) {
    if (!is_ignorable(c)) return false;
    if (c != kHyphenation) return true;
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    return rest.empty() || !is_line_end(static_cast<unsigned char>(rest.front()));
}

std::string letters_of(char32_t c, Reading reading) {
    return reading == Reading::kLookAlike ? folded_letter(look_alike(c)) : folded_letter(c);
}

/// Remembers the signs since the last token.
class GapMeter {
  public:
    void add(char32_t c) {
        if (is_unseen(c)) {
            blank_ = true;
            new_line_ = new_line_ || is_line_end(c);
            return;
        }
        hyphen_only_ = signs_ == 0 && !blank_ && is_hyphen(c);
        ++signs_;
    }
    Gap gap() const {
        if (signs_ == 0) return blank_ ? Gap::kSpace : Gap::kNone;
        if (signs_ == 1 && hyphen_only_ && new_line_) return Gap::kBreak;
        return signs_ <= kMinWidth ? Gap::kNarrow : Gap::kWide;
    }

  private:
    std::size_t signs_ = 0;
    bool blank_ = false, new_line_ = false, hyphen_only_ = false;
};

}  // namespace

std::vector<NameToken> name_tokens(std::string_view utf8, Reading reading) {
    std::vector<NameToken> tokens;
    GapMeter meter;
    bool open = false, small_before = false;
    std::string_view rest = utf8;
    while (!rest.empty()) {
        const std::size_t begin = utf8.size() - rest.size();
        const char32_t c = next_character(rest);
        const std::size_t end = utf8.size() - rest.size();
        if (is_unheard(c, rest)) {
            if (open) tokens.back().end = end;
            continue;
        }
        const std::string letters = letters_of(c, reading);
        if (letters.empty()) {
            meter.add(c);
            open = false;
            continue;
        }
        const bool digit = letters.front() >= '0' && letters.front() <= '9';
        const bool alone = is_ideograph(c);
        const bool capital = is_capital(c);
        const bool hump = reading == Reading::kCamel && capital && small_before;
        small_before = !digit && !capital;
        if (!open || alone || hump || tokens.back().digits != digit) {
            const Gap gap = tokens.empty() ? Gap::kWide : meter.gap();
            tokens.push_back({"", begin, end, digit, alone || capital, gap});
        }
        tokens.back().letters += letters;
        tokens.back().end = end;
        meter = GapMeter();
        open = !alone;
    }
    return tokens;
}

bool reads_otherwise(std::string_view utf8, Reading reading) {
    bool small_before = false;
    for (std::string_view rest = utf8; !rest.empty();) {
        const char32_t c = next_character(rest);
        if (reading == Reading::kLookAlike && look_alike(c) != c) return true;
        if (reading == Reading::kCamel) {
            if (small_before && is_capital(c)) return true;
            small_before = c < 0x80 ? c >= 'a' && c <= 'z' : !folded_letter(c).empty() && !is_capital(c);
        }
    }
    return false;
}

}  // namespace dynlab::inline platform
