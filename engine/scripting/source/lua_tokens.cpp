#include "scripting/source/lua_tokens.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace dynlab::inline scripting {
namespace {

constexpr std::array<std::string_view, 10> kLongSigns = {"...", "..", "::", "==", "~=", "<=", ">=", "//", "<<", ">>"};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::vector<LuaToken> scan() {
        while (offset_ < text_.size()) {
            const char c = text_[offset_];
            if (c == ' ' || (c >= '\t' && c <= '\r')) {
                ++offset_;
            } else if (starts("--")) {
                skip_comment();
            } else {
                take_token();
            }
        }
        return std::move(tokens_);
    }

  private:
    using Kind = LuaToken::Kind;

    bool starts(std::string_view word) const { return text_.substr(offset_).starts_with(word); }

    void take(Kind kind, std::size_t end) {
        tokens_.push_back({kind, text_.substr(offset_, end - offset_), offset_});
        offset_ = end;
    }

    void take_token() {
        const char c = text_[offset_];
        if (is_digit(c) || (c == '.' && offset_ + 1 < text_.size() && is_digit(text_[offset_ + 1])))
            return take_number();
        if (is_name_character(c)) return take_word();
        if (c == '"' || c == '\'') return take_string(c);
        if (const auto level = long_bracket(offset_)) {
            const auto end = end_of_long_bracket(offset_, *level);
            return take(end ? Kind::kString : Kind::kUnfinished, end.value_or(text_.size()));
        }
        for (std::string_view sign : kLongSigns)
            if (c == sign.front() && starts(sign)) return take(Kind::kSign, offset_ + sign.size());
        take(Kind::kSign, offset_ + 1);
    }

    void take_word() {
        std::size_t end = offset_;
        while (end < text_.size() && is_name_character(text_[end])) ++end;
        const auto& keywords = lua_keywords();
        const bool reserved = std::ranges::binary_search(keywords, text_.substr(offset_, end - offset_));
        take(reserved ? Kind::kKeyword : Kind::kName, end);
    }

    /// 12, 0x1F, 1e-5, .5; the range operator's dots do not belong to it.
    void take_number() {
        std::size_t end = offset_;
        while (end < text_.size()) {
            const char c = text_[end];
            const bool exponent_sign = (c == '+' || c == '-') && end > offset_ &&
                                       std::string_view("eEpP").find(text_[end - 1]) != std::string_view::npos &&
                                       !starts("0x");
            const bool point = c == '.' && text_.substr(end, 2) != "..";
            if (!is_name_character(c) && !point && !exponent_sign) break;
            ++end;
        }
        take(Kind::kNumber, std::max(end, offset_ + 1));
    }

    void take_string(char quote) {
        std::size_t end = offset_ + 1;
        while (end < text_.size() && text_[end] != quote && text_[end] != '\n')
            end += text_[end] == '\\' && end + 1 < text_.size() ? 2 : 1;
        const bool closed = end < text_.size() && text_[end] == quote;
        take(closed ? Kind::kString : Kind::kUnfinished, std::min(end + (closed ? 1 : 0), text_.size()));
    }

    /// Number of = signs of a long bracket [==[ that starts at `offset`.
    std::optional<std::size_t> long_bracket(std::size_t offset) const {
        if (offset >= text_.size() || text_[offset] != '[') return std::nullopt;
        std::size_t end = offset + 1;
        while (end < text_.size() && text_[end] == '=') ++end;
        if (end >= text_.size() || text_[end] != '[') return std::nullopt;
        return end - offset - 1;
    }

    std::optional<std::size_t> end_of_long_bracket(std::size_t offset, std::size_t level) const {
        const std::string closing = "]" + std::string(level, '=') + "]";
        const auto found = text_.find(closing, offset + level + 2);
        if (found == std::string_view::npos) return std::nullopt;
        return found + closing.size();
    }

    void skip_comment() {
        if (const auto level = long_bracket(offset_ + 2)) {
            const auto end = end_of_long_bracket(offset_ + 2, *level);
            if (!end) return take(Kind::kUnfinished, text_.size());
            offset_ = *end;
        } else {
            offset_ = std::min(text_.find('\n', offset_), text_.size());
        }
    }

    std::string_view text_;
    std::size_t offset_ = 0;
    std::vector<LuaToken> tokens_;
};

}  // namespace

std::vector<LuaToken> lua_tokens(std::string_view text) {
    return Scanner(text).scan();
}

bool begins_line(std::string_view code, const std::vector<LuaToken>& tokens, std::size_t i) {
    if (i == 0) return true;
    const std::string_view between = code.substr(tokens[i - 1].end(), tokens[i].begin - tokens[i - 1].end());
    return between.find('\n') != std::string_view::npos;
}

const std::vector<std::string_view>& lua_keywords() {
    static const std::vector<std::string_view> words = {
        "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
        "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};
    return words;
}

bool is_name_character(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_variable_name(std::string_view word) {
    const std::vector<std::string_view>& reserved = lua_keywords();
    return !word.empty() && !is_digit(word.front()) && std::ranges::all_of(word, is_name_character) &&
           !std::ranges::binary_search(reserved, word);
}

}  // namespace dynlab::inline scripting
