#include "course/names/content_text.h"

#include <cstdlib>
#include <vector>

#include "course/names/byte_text.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr double kSpace = -180;  ///< thousandths of the font's size: moved on as far as a space
constexpr std::uint32_t kLongestRange = 65536;

bool is_white_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\0';
}

bool ends_word(char c) {
    return is_white_space(c) || std::string_view("()<>[]{}/%").find(c) != std::string_view::npos;
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Reads strings, numbers and operators off a content stream or a map.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : rest_(text) {}

    enum class Kind { kEnd, kString, kWord, kOther };
    Kind next() {
        skip_blanks();
        token_.clear();
        if (rest_.empty()) return Kind::kEnd;
        const char c = rest_.front();
        if (c == '(') return literal();
        if (rest_.starts_with("<<") || rest_.starts_with(">>")) {
            take();
            take();
            return Kind::kOther;
        }
        if (c == '<') return hexadecimal();
        if (c == '/') rest_.remove_prefix(1);
        while (!rest_.empty() && !ends_word(rest_.front())) take();
        if (c == '/') return Kind::kOther;
        if (!token_.empty()) return Kind::kWord;
        take();
        return Kind::kOther;
    }
    const std::string& token() const { return token_; }

  private:
    void take() {
        token_ += rest_.front();
        rest_.remove_prefix(1);
    }
    void skip_blanks() {
        while (!rest_.empty() && (is_white_space(rest_.front()) || rest_.front() == '%')) {
            if (rest_.front() == '%')
                rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
            else
                rest_.remove_prefix(1);
        }
    }
    Kind literal() {
        int depth = 0;
        while (!rest_.empty()) {
            const char c = rest_.front();
            rest_.remove_prefix(1);
            if (c == '\\') {
                escape();
                continue;
            }
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (depth == 0) break;
            if (depth > 1 || c != '(') token_ += c;
        }
        return Kind::kString;
    }
    void escape() {
        if (rest_.empty()) return;
        int code = 0, digits = 0;
        while (digits < 3 && !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '7') {
            code = 8 * code + (rest_.front() - '0');
            rest_.remove_prefix(1);
            ++digits;
        }
        if (digits > 0) {
            token_ += static_cast<char>(code);
            return;
        }
        const char c = rest_.front();
        rest_.remove_prefix(1);
        if (c != '\n' && c != '\r') token_ += c == 'n' || c == 'r' || c == 't' ? ' ' : c;
    }
    Kind hexadecimal() {
        rest_.remove_prefix(1);
        int half = -1;
        while (!rest_.empty() && rest_.front() != '>') {
            const int value = hex_value(rest_.front());
            rest_.remove_prefix(1);
            if (value < 0) continue;
            if (half < 0) {
                half = value;
                continue;
            }
            token_ += static_cast<char>(16 * half + value);
            half = -1;
        }
        if (half >= 0) token_ += static_cast<char>(16 * half);
        if (!rest_.empty()) rest_.remove_prefix(1);
        return Kind::kString;
    }

    std::string_view rest_;
    std::string token_;
};

std::uint32_t number_of(const std::string& code) {
    std::uint32_t number = 0;
    for (const char c : code) number = number << 8 | static_cast<unsigned char>(c);
    return number;
}

std::string text_of_units(const std::string& utf16) {
    return text_in("\xFE\xFF" + utf16);
}

/// The last unit of a UTF-16 text raised by `by`.
std::string raised(std::string utf16, std::uint32_t by) {
    for (std::size_t i = utf16.size(); i > 0 && by > 0; --i) {
        by += static_cast<unsigned char>(utf16[i - 1]);
        utf16[i - 1] = static_cast<char>(by & 0xFF);
        by >>= 8;
    }
    return utf16;
}

void add_range(CodeMap& map, const std::vector<std::string>& codes) {
    for (std::size_t i = 0; i + 2 < codes.size(); i += 3) {
        const std::uint32_t first = number_of(codes[i]), last = number_of(codes[i + 1]);
        map.bytes = codes[i].size();
        for (std::uint32_t code = first; code <= last && code - first < kLongestRange; ++code)
            map.text[code] = text_of_units(raised(codes[i + 2], code - first));
    }
}

/// A range whose texts are a list, <01> <03> [<0041> <00C9> <0042>], from `list` on; takes it off the codes.
void add_list(CodeMap& map, std::vector<std::string>& codes, std::size_t list) {
    if (list < 2 || list > codes.size()) return;
    const std::uint32_t first = number_of(codes[list - 2]);
    map.bytes = codes[list - 2].size();
    for (std::size_t i = list; i < codes.size(); ++i)
        map.text[first + static_cast<std::uint32_t>(i - list)] = text_of_units(codes[i]);
    codes.resize(list - 2);
}

std::string decoded(const std::string& bytes, const CodeMap* map) {
    std::string text;
    if (map == nullptr) {
        for (const char c : bytes) text += utf8_of(char32_t{static_cast<unsigned char>(c)});
        return text;
    }
    for (std::size_t i = 0; i + map->bytes <= bytes.size(); i += map->bytes) {
        const auto found = map->text.find(number_of(bytes.substr(i, map->bytes)));
        text += found == map->text.end() ? " " : found->second;
    }
    return text;
}

}  // namespace

CodeMap code_map(const std::string& to_unicode) {
    CodeMap map;
    Scanner scanner(to_unicode);
    std::vector<std::string> codes;
    std::size_t list = 0;  // where it begins among the codes
    for (Scanner::Kind kind = scanner.next(); kind != Scanner::Kind::kEnd; kind = scanner.next()) {
        if (kind == Scanner::Kind::kString) codes.push_back(scanner.token());
        if (kind == Scanner::Kind::kOther && scanner.token() == "[") list = codes.size();
        if (kind == Scanner::Kind::kOther && scanner.token() == "]") add_list(map, codes, list);
        if (kind != Scanner::Kind::kWord) continue;
        if (scanner.token() == "endbfchar") {
            for (std::size_t i = 0; i + 1 < codes.size(); i += 2) {
                map.bytes = codes[i].size();
                map.text[number_of(codes[i])] = text_of_units(codes[i + 1]);
            }
        } else if (scanner.token() == "endbfrange") {
            add_range(map, codes);
        }
        codes.clear();
    }
    if (map.bytes == 0) map.bytes = 1;
    return map;
}

bool shows_text(std::string_view stream) {
    return (stream.find("Tj") != std::string_view::npos || stream.find("TJ") != std::string_view::npos ||
            stream.find('\'') != std::string_view::npos || stream.find("BDC") != std::string_view::npos) &&
           is_text(stream.substr(0, 200));
}

std::vector<ShownPiece> shown_pieces(std::string_view stream) {
    std::vector<ShownPiece> pieces;
    const auto move = [&pieces](const char* space) { pieces.push_back({space, false}); };
    Scanner scanner(stream);
    bool in_array = false;
    for (Scanner::Kind kind = scanner.next(); kind != Scanner::Kind::kEnd; kind = scanner.next()) {
        const std::string& token = scanner.token();
        if (kind == Scanner::Kind::kString) {
            const bool coded = !token.starts_with("\xFE\xFF");
            pieces.push_back({coded ? token : text_in(token), coded});
        } else if (kind == Scanner::Kind::kOther) {
            if (token == "[") in_array = true;
            if (token == "]") in_array = false;
            if (token == "<<" || token == ">>") move("\n");
        } else if (in_array) {
            if (std::strtod(token.c_str(), nullptr) < kSpace) move(" ");
        } else if (token == "Td" || token == "TD" || token == "Tm" || token == "T*" || token == "ET" ||
                   token == "BDC") {
            move("\n");
        }
    }
    return pieces;
}

std::string shown_text(const std::vector<ShownPiece>& pieces, const CodeMap* map) {
    std::string text;
    for (const ShownPiece& piece : pieces) text += piece.coded ? decoded(piece.bytes, map) : piece.bytes;
    return text;
}

}  // namespace dynlab::inline course
