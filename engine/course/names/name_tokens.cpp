#include "course/names/name_tokens.h"

#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kNarrowest = 3;  ///< signs

bool is_unseen(char32_t c) {
    return c == ' ' || (c >= '\t' && c <= '\r') || c == 0xA0 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F ||
           c == 0x3000;
}

bool is_hyphen(char32_t c) {
    return c == '-' || c == 0x2010 || c == 0x2011;
}

/// Remembers the signs since the last token.
class GapMeter {
  public:
    void add(char32_t c) {
        if (is_unseen(c)) {
            blank_ = true;
            new_line_ = new_line_ || c == '\n' || c == '\r';
            return;
        }
        hyphen_only_ = signs_ == 0 && !blank_ && is_hyphen(c);
        ++signs_;
    }
    Gap gap() const {
        if (signs_ == 0) return blank_ ? Gap::kSpace : Gap::kNone;
        if (signs_ == 1 && hyphen_only_ && new_line_) return Gap::kBreak;
        return signs_ <= kNarrowest ? Gap::kNarrow : Gap::kWide;
    }

  private:
    std::size_t signs_ = 0;
    bool blank_ = false, new_line_ = false, hyphen_only_ = false;
};

}  // namespace

std::vector<NameToken> name_tokens(std::string_view utf8) {
    std::vector<NameToken> tokens;
    GapMeter meter;
    bool open = false;
    std::string_view rest = utf8;
    while (!rest.empty()) {
        const std::size_t begin = utf8.size() - rest.size();
        const char32_t c = next_character(rest);
        const std::size_t end = utf8.size() - rest.size();
        if (is_silent(c)) {
            if (open) tokens.back().end = end;
            continue;
        }
        const std::string letters = folded_letter(c);
        if (letters.empty()) {
            meter.add(c);
            open = false;
            continue;
        }
        const bool digit = letters.front() >= '0' && letters.front() <= '9';
        const bool alone = is_ideograph(c);
        if (!open || alone || tokens.back().digits != digit) {
            const Gap gap = tokens.empty() ? Gap::kWide : meter.gap();
            tokens.push_back({"", begin, end, digit, alone || is_capital(c), gap});
        }
        tokens.back().letters += letters;
        tokens.back().end = end;
        meter = GapMeter();
        open = !alone;
    }
    return tokens;
}

}  // namespace dynlab::inline course
