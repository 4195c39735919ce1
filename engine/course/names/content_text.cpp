#include "course/names/content_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <qpdf/BufferInputSource.hh>
#include <qpdf/QPDFTokenizer.hh>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "course/names/byte_text.h"
#include "platform/text/read_number.h"
#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

constexpr double kSpace = -180;  ///< thousandths of the font's size: moved on as far as a space
constexpr std::uint32_t kLongestRange = 65536;
constexpr std::size_t kShortString = 8;                               ///< bytes: four letters in codes of two
constexpr double kSameLine = 0.4, kNextLetter = 1.05, kFarApart = 3;  ///< of the font's size
constexpr double kDirectionStep = 2 * 3.141592653589793 / 180;
constexpr char kApart[] = "\n----\n";  ///< more signs than there are within a name

/// Reads the tokens of a content stream or a map, whatever they are.
class ContentTokens {
  public:
    using Kind = QPDFTokenizer::token_type_e;

    explicit ContentTokens(std::string_view text)
        : buffer_(reinterpret_cast<unsigned char*>(const_cast<char*>(text.data())), text.size()),
          input_(std::make_shared<BufferInputSource>("text", &buffer_)) {
        tokenizer_.allowEOF();
        tokenizer_.includeIgnorable();  // comments
    }

    Kind next() {
        token_ = tokenizer_.readToken(input_, "", true);
        if (token_.isWord("ID")) tokenizer_.expectInlineImage(input_);
        return token_.getType();
    }
    const std::string& token() const { return token_.getValue(); }

  private:
    Buffer buffer_;  // libqpdf only reads it
    std::shared_ptr<BufferInputSource> input_;
    QPDFTokenizer tokenizer_;
    QPDFTokenizer::Token token_;
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

/// Words of a content stream (ISO 32000-1, annex A).
bool is_operator(const std::string& word) {
    static const std::set<std::string> operators = {
        "b",  "B",  "b*", "B*", "BDC", "BI",  "BMC", "BT", "BX", "c",  "cm", "CS", "cs", "d",  "d0",
        "d1", "Do", "DP", "EI", "EMC", "ET",  "EX",  "f",  "F",  "f*", "G",  "g",  "gs", "h",  "i",
        "ID", "j",  "J",  "K",  "k",   "l",   "m",   "M",  "MP", "n",  "q",  "Q",  "re", "RG", "rg",
        "ri", "s",  "S",  "SC", "sc",  "SCN", "scn", "sh", "T*", "Tc", "Td", "TD", "Tf", "Tj", "TJ",
        "TL", "Tm", "Tr", "Ts", "Tw",  "Tz",  "v",   "w",  "W",  "W*", "y",  "'",  "\""};
    return operators.contains(word);
}

/// Signs with names of their own in fonts, and digits.
std::string sign_of_glyph(const std::string& name) {
    static const std::map<std::string, std::string> signs = {
        {"zero", "0"},       {"one", "1"},        {"two", "2"},      {"three", "3"},  {"four", "4"},
        {"five", "5"},       {"six", "6"},        {"seven", "7"},    {"eight", "8"},  {"nine", "9"},
        {"space", " "},      {"hyphen", "-"},     {"comma", ","},    {"period", "."}, {"slash", "/"},
        {"at", "@"},         {"underscore", "_"}, {"ff", "ff"},      {"fi", "fi"},    {"fl", "fl"},
        {"ffi", "ffi"},      {"ffl", "ffl"},      {"dotlessi", "i"}, {"colon", ":"},  {"semicolon", ";"},
        {"quoteright", "'"}, {"germandbls", "ss"}};
    const auto found = signs.find(name);
    return found == signs.end() ? "" : found->second;
}

/// "uni00E9", "u1D400".
std::string character_of_glyph(const std::string& name) {
    const std::size_t digits = name.starts_with("uni") ? 3 : name.starts_with("u") ? 1 : name.size();
    if (name.size() < digits + 4) return "";
    const auto code = read_number<std::uint32_t>(name.substr(digits), 16);
    return code ? utf8_of(char32_t{*code}) : "";
}

/// [a b c d e f] of ISO 32000-1, 8.3.3.
using TextMatrix = std::array<double, 6>;
constexpr TextMatrix kUnmoved = {1, 0, 0, 1, 0, 0};

TextMatrix product(const TextMatrix& m, const TextMatrix& n) {
    return {m[0] * n[0] + m[1] * n[2], m[0] * n[1] + m[1] * n[3],        m[2] * n[0] + m[3] * n[2],
            m[2] * n[1] + m[3] * n[3], m[4] * n[0] + m[5] * n[2] + n[4], m[4] * n[1] + m[5] * n[3] + n[5]};
}

/// A string where it begins on the page, in points along and across the direction of its text.
struct PlacedPiece {
    std::string bytes;
    double along = 0, across = 0, size = 0;
    long direction = 0, line = 0;  ///< direction: in steps of two degrees
};

/// Lines of a direction, numbered from the top: what is less than a part of a letter's height apart is on one.
void number_lines(std::vector<PlacedPiece>& pieces) {
    std::vector<PlacedPiece*> all;
    for (PlacedPiece& piece : pieces) all.push_back(&piece);
    std::stable_sort(all.begin(), all.end(), [](const PlacedPiece* a, const PlacedPiece* b) {
        return std::tuple(a->direction, -a->across) < std::tuple(b->direction, -b->across);
    });
    for (std::size_t i = 1; i < all.size(); ++i) {
        const bool same = all[i]->direction == all[i - 1]->direction &&
                          all[i - 1]->across - all[i]->across <= kSameLine * all[i]->size;
        all[i]->line = all[i - 1]->line + (same ? 0 : 1);
    }
}

/// Follows where text goes, as far as that can be said without the widths of letters.
class PlacesOfText {
  public:
    std::vector<PlacedPiece> read(std::string_view stream) {
        ContentTokens tokens(stream);
        for (auto kind = tokens.next(); kind != QPDFTokenizer::tt_eof; kind = tokens.next()) {
            const std::string& token = tokens.token();
            if (kind == QPDFTokenizer::tt_string)
                shown_ += token;
            else if (kind == QPDFTokenizer::tt_integer || kind == QPDFTokenizer::tt_real)
                note_number(std::strtod(token.c_str(), nullptr));
            else if (kind == QPDFTokenizer::tt_word)
                obey(token);
        }
        return std::move(pieces_);
    }

  private:
    void obey(const std::string& word) {
        if (word == "Tj" || word == "TJ" || word == "'" || word == "\"") {
            if (word == "'" || word == "\"") move(0, -leading_);
            show();
        } else if (word == "cm" && numbers_.size() >= 6) {
            page_ = product(last_six(), page_);
        } else if (word == "q") {
            if (kept_.size() < kMostKept) kept_.push_back(page_);
        } else if (word == "Q" && !kept_.empty()) {
            page_ = kept_.back();
            kept_.pop_back();
        } else if (word == "BT") {
            line_ = kUnmoved;
        } else if (word == "Tm" && numbers_.size() >= 6) {
            line_ = last_six();
        } else if ((word == "Td" || word == "TD") && numbers_.size() >= 2) {
            if (word == "TD") leading_ = -numbers_.back();
            move(numbers_[numbers_.size() - 2], numbers_.back());
        } else if (word == "T*") {
            move(0, -leading_);
        } else if (word == "TL" && !numbers_.empty()) {
            leading_ = numbers_.back();
        } else if (word == "Tf" && !numbers_.empty()) {
            size_ = numbers_.back();
        }
        numbers_.clear();
        shown_.clear();
    }

    TextMatrix last_six() const {
        TextMatrix matrix;
        std::copy(numbers_.end() - 6, numbers_.end(), matrix.begin());
        return matrix;
    }

    /// No operator has more than six; a text that is all numbers is kept short.
    void note_number(double number) {
        constexpr std::size_t kMostNumbers = 1000;
        if (numbers_.size() >= kMostNumbers) numbers_.clear();
        numbers_.push_back(number);
    }

    void move(double x, double y) { line_ = product({1, 0, 0, 1, x, y}, line_); }

    void show() {
        if (shown_.empty() || shown_.size() > kShortString) return;
        const TextMatrix place = product(line_, page_);
        const double angle = std::atan2(place[1], place[0]), c = std::cos(angle), s = std::sin(angle);
        const double along = c * place[4] + s * place[5], across = c * place[5] - s * place[4];
        const double size = std::abs(size_) * std::hypot(place[0], place[1]);
        if (!std::isfinite(along) || !std::isfinite(across) || !std::isfinite(size)) return;
        pieces_.push_back({shown_, along, across, size, std::lround(angle / kDirectionStep), 0});
    }

    std::vector<PlacedPiece> pieces_;
    std::vector<double> numbers_;
    std::string shown_;
    static constexpr std::size_t kMostKept = 10'000;
    std::vector<TextMatrix> kept_;
    TextMatrix page_ = kUnmoved, line_ = kUnmoved;
    double leading_ = 0, size_ = 1;
};

}  // namespace

std::string text_of_glyph(const std::string& name) {
    const std::string bare = name.substr(0, name.find('.'));
    std::string text;
    for (std::size_t begin = 0; begin < bare.size();) {
        const std::size_t end = std::min(bare.find('_', begin), bare.size());
        const std::string part = bare.substr(begin, end - begin), entity = "&" + part + ";";
        const std::string letter = without_references(entity);
        const std::string sign = sign_of_glyph(part), character = character_of_glyph(part);
        text += part.size() == 1 ? part : !sign.empty() ? sign : letter != entity ? letter : character;
        begin = end + 1;
    }
    return text;
}

bool is_known_glyph(const std::string& name) {
    return !text_of_glyph(name).empty();
}

CodeMap code_map_of_glyphs(const std::vector<std::pair<std::uint32_t, std::string>>& glyphs) {
    const auto is_plain = [](const auto& glyph) {
        const bool letter = glyph.second.size() == 1 && std::isalpha(static_cast<unsigned char>(glyph.second[0])) != 0;
        return !letter || glyph.first == static_cast<unsigned char>(glyph.second[0]);
    };
    CodeMap map;
    if (std::all_of(glyphs.begin(), glyphs.end(), is_plain)) return map;
    for (std::uint32_t code = ' '; code < 127; ++code) map.text[code] = static_cast<char>(code);
    for (const auto& [code, name] : glyphs) {
        const std::string text = text_of_glyph(name);
        map.text[code] = text.empty() ? " " : text;
    }
    return map;
}

CodeMap code_map(const std::string& to_unicode) {
    CodeMap map;
    ContentTokens tokens(to_unicode);
    std::vector<std::string> codes;
    std::size_t list = 0;  // where it begins among the codes
    for (auto kind = tokens.next(); kind != QPDFTokenizer::tt_eof; kind = tokens.next()) {
        if (kind == QPDFTokenizer::tt_string) codes.push_back(tokens.token());
        if (kind == QPDFTokenizer::tt_array_open) list = codes.size();
        if (kind == QPDFTokenizer::tt_array_close) add_list(map, codes, list);
        if (kind != QPDFTokenizer::tt_word) continue;
        if (tokens.token() == "endbfchar") {
            for (std::size_t i = 0; i + 1 < codes.size(); i += 2) {
                map.bytes = codes[i].size();
                map.text[number_of(codes[i])] = text_of_units(codes[i + 1]);
            }
        } else if (tokens.token() == "endbfrange") {
            add_range(map, codes);
        }
        codes.clear();
    }
    if (map.bytes == 0) map.bytes = 1;
    return map;
}

std::size_t bytes_of_identity(const std::string& cmap) {
    ContentTokens tokens(cmap);
    std::vector<std::string> codes;
    std::vector<long> cids;
    std::size_t bytes = 0;
    bool is_identity = true, maps = false;
    for (auto kind = tokens.next(); is_identity && kind != QPDFTokenizer::tt_eof; kind = tokens.next()) {
        const std::string& token = tokens.token();
        if (kind == QPDFTokenizer::tt_string) codes.push_back(token);
        if (kind == QPDFTokenizer::tt_integer) cids.push_back(std::strtol(token.c_str(), nullptr, 10));
        if (kind == QPDFTokenizer::tt_bad) return 0;
        if (kind != QPDFTokenizer::tt_word) continue;
        const std::size_t of_entry = token == "endcidrange" ? 2 : token == "endcidchar" ? 1 : 0;
        if (token == "usecmap") return 0;
        if (token == "endcodespacerange" || of_entry > 0) {
            if (bytes == 0 && !codes.empty()) bytes = codes.front().size();
            for (const std::string& code : codes) is_identity = is_identity && code.size() == bytes;
        }
        if (of_entry > 0) {
            is_identity = is_identity && codes.size() == of_entry * cids.size();
            for (std::size_t i = 0; is_identity && i < cids.size(); ++i)
                is_identity = std::cmp_equal(number_of(codes[of_entry * i]), cids[i]);
            maps = maps || !cids.empty();
        }
        codes.clear();
        cids.clear();
    }
    return is_identity && maps ? bytes : 0;
}

bool shows_text(std::string_view stream) {
    const bool has_operator =
        stream.find("Tj") != std::string_view::npos || stream.find("TJ") != std::string_view::npos ||
        stream.find('\'') != std::string_view::npos || stream.find("BDC") != std::string_view::npos;
    if (!has_operator) return false;
    while (stream.starts_with('%')) {  // a comment may hold any bytes
        const std::size_t end = std::min(stream.find_first_of("\r\n"), stream.size());
        const std::size_t next = stream.find_first_not_of("\r\n \t", end);
        if (next == std::string_view::npos) break;
        stream.remove_prefix(next);
    }
    return is_text(stream.substr(0, 200));
}

std::vector<ShownPiece> shown_pieces(std::string_view stream, UnshownText* unshown) {
    std::vector<ShownPiece> pieces;
    const auto move = [&pieces](const char* space) { pieces.push_back({space, false}); };
    static const std::set<std::string> moves = {"Td", "TD", "Tm", "T*", "ET", "BDC"};
    ContentTokens tokens(stream);
    std::set<std::string> known;
    const auto note = [&](const std::string& words) {
        if (unshown != nullptr && known.insert(words).second) unshown->words += text_in(words) + kApart;
    };
    bool in_array = false;
    for (auto kind = tokens.next(); kind != QPDFTokenizer::tt_eof; kind = tokens.next()) {
        const std::string& token = tokens.token();
        switch (kind) {
            case QPDFTokenizer::tt_string: {
                const bool coded = !token.starts_with("\xFE\xFF");
                pieces.push_back({coded ? token : text_in(token), coded});
                break;
            }
            case QPDFTokenizer::tt_array_open:
            case QPDFTokenizer::tt_array_close:
                in_array = kind == QPDFTokenizer::tt_array_open;
                break;
            case QPDFTokenizer::tt_dict_open:
            case QPDFTokenizer::tt_dict_close:
                move("\n");
                break;
            case QPDFTokenizer::tt_integer:
            case QPDFTokenizer::tt_real:
                if (in_array && std::strtod(token.c_str(), nullptr) < kSpace) move(" ");
                break;
            case QPDFTokenizer::tt_word:
                if (moves.contains(token)) move("\n");
                if (!is_operator(token)) note(token);
                break;
            case QPDFTokenizer::tt_name:
            case QPDFTokenizer::tt_comment:
            case QPDFTokenizer::tt_bad:
                note(token);
                break;
            case QPDFTokenizer::tt_inline_image:
                if (unshown != nullptr) unshown->pictures += text_in(token) + '\n';
                break;
            default:
                break;
        }
    }
    return pieces;
}

std::vector<ShownPiece> pieces_by_place(std::string_view stream) {
    std::vector<PlacedPiece> pieces = PlacesOfText().read(stream);
    const auto is_before = [](const PlacedPiece& a, const PlacedPiece& b) {
        return std::tuple(a.direction, a.line, a.along) < std::tuple(b.direction, b.line, b.along);
    };
    number_lines(pieces);
    if (std::is_sorted(pieces.begin(), pieces.end(), is_before)) return {};
    std::stable_sort(pieces.begin(), pieces.end(), is_before);
    std::vector<ShownPiece> shown;
    const PlacedPiece* last = nullptr;
    for (const PlacedPiece& piece : pieces) {
        const bool same_line = last && last->direction == piece.direction && last->line == piece.line;
        const double gap = same_line ? (piece.along - last->along) / std::max(last->size, 0.1) : 0;
        if (last && (!same_line || gap > kFarApart))
            shown.push_back({kApart, false});
        else if (gap > kNextLetter)
            shown.push_back({" ", false});
        shown.push_back({piece.bytes, true});
        last = &piece;
    }
    return shown;
}

std::string shown_text(const std::vector<ShownPiece>& pieces, const CodeMap* map) {
    std::string text;
    for (const ShownPiece& piece : pieces) text += piece.coded ? decoded(piece.bytes, map) : piece.bytes;
    return text;
}

}  // namespace dynlab::inline course
